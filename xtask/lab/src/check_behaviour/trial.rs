//! Simulates one trial and its counterfactual.

use super::{
    judge,
    report::Trial,
    rows::{BehaviourTest, Criterion},
};
use core::ops::ControlFlow;
use phase_cli::{context::Context, progress::Progress};
use phase_dataset::event_cache::EventCache;
use phase_event::Event;
use phase_evidence::Track;
use phase_files::{
    checksum::{hexadecimal, sha256},
    folder::Folder,
    run,
};
use phase_model::{AgentId, Attitude, Flip, Scene};
use phase_runs::{
    engine,
    error::RunError,
    event_writer::{self, settings_value},
    interrupt::requested,
    words,
};
use phase_sim::SimulationSettings;
use serde_json::json;
use std::{path::PathBuf, time::Instant};

/// The reflections that seeds use in rotation.
const FLIPS: [Option<Flip>; 5] =
    [None, Some(Flip::UpDown), Some(Flip::LeftRight), Some(Flip::Diagonal), Some(Flip::AntiDiagonal)];

/// Simulates the trials, reusing those of an interrupted run.
#[derive(Debug)]
pub(super) struct TrialRunner {
    settings: SimulationSettings,
    cache: PathBuf,
    program: [u8; 32],
    progress: Progress,
}

/// The share of an agent's particles that suppose that the other hinders it, averaged over the steps of an
/// event; `None` if the agent supposes nothing, since it knows the other's goal.
fn suspicion(event: &Event, agent: AgentId) -> Option<f64> {
    let shares: Vec<f64> = event
        .steps
        .iter()
        .filter_map(|step| {
            let intents = &step.thoughts[agent].intents;
            let of = |hinders: bool| {
                let chosen = intents.iter().filter(|it| !hinders || it.intent.attitude == Attitude::Hinder);
                chosen.map(|it| it.particles as f64).sum::<f64>()
            };
            (of(false) > 0.0).then(|| of(true) / of(false))
        })
        .collect();
    (!shares.is_empty()).then(|| shares.iter().sum::<f64>() / shares.len() as f64)
}

/// The unique name of a part: parts may share scenes.
pub(super) fn key(part: &BehaviourTest) -> String {
    match (part.lambda, part.criterion) {
        (Some(lambda), _) => format!("{}-lambda{lambda}", part.name),
        (None, Criterion::Unseen) => format!("{}-unseen", part.name),
        (None, _) => part.name.into(),
    }
}

impl TrialRunner {
    pub(super) fn new(
        folder: &Folder,
        settings: SimulationSettings,
        events: usize,
        context: &Context,
    ) -> Self {
        let program = event_writer::program();
        let progress =
            context.progress(&format!("simulating {}", words::events(events)), events, settings.max_steps);
        Self { settings, cache: folder.cache(), program, progress }
    }

    /// Simulates a scene with the seed of this index and judges it; `None` if interrupted.
    pub(super) fn trial(
        &self,
        part: &BehaviourTest,
        id: &str,
        scene: &Scene,
        index: usize,
    ) -> Result<Option<Trial>, RunError> {
        let Some(event) = self.event(part, id, scene, index)? else { return Ok(None) };
        let control = match part.control {
            Some(agent) => {
                let Some(control) = self.control(part, id, scene, index, agent)? else { return Ok(None) };
                Some(Track::of_event(&control))
            }
            None => None,
        };
        let mut verdict = judge::judge(part, &event.scene, &Track::of_event(&event), control.as_ref());
        if part.criterion == Criterion::Unseen
            && let Some(share) = suspicion(&event, part.judged)
        {
            verdict.notes += &format!("; {:.0} % suspicion", 100.0 * share);
        }
        let flip = event.scene.layout.flip();
        Ok(Some(Trial { seed: event.seed, flip, steps: event.steps.len(), verdict }))
    }

    /// The event of a scene and the seed of this index.
    pub(super) fn event(
        &self,
        part: &BehaviourTest,
        id: &str,
        scene: &Scene,
        index: usize,
    ) -> Result<Option<Event>, RunError> {
        let settings = self.settings_of(part);
        self.play(&format!("{}.{id}", key(part)), mirrored(scene, index), index, &settings)
    }

    /// Simulates a scene without an agent's contribution: it is neutral and stays where it is.
    fn control(
        &self,
        part: &BehaviourTest,
        id: &str,
        scene: &Scene,
        index: usize,
        agent: AgentId,
    ) -> Result<Option<Event>, RunError> {
        let mut scene = mirrored(scene, index);
        scene.agents[agent].attitude = Attitude::Neutral;
        let settings = SimulationSettings { idle: Some(agent), ..self.settings_of(part) };
        self.play(&format!("{}.{id}.without{agent}", key(part)), scene, index, &settings)
    }

    fn settings_of(&self, part: &BehaviourTest) -> SimulationSettings {
        let mut settings = SimulationSettings { idle: part.idle, ..self.settings };
        if part.runs_full_length {
            settings.rest_steps = usize::MAX;
        }
        if let Some(lambda) = part.lambda {
            settings.minds = settings.minds.with_lambda(lambda);
        }
        settings
    }

    fn play(
        &self,
        name: &str,
        scene: Scene,
        index: usize,
        settings: &SimulationSettings,
    ) -> Result<Option<Event>, RunError> {
        let seed = index as u64 + 1;
        let name = format!("{name}.{seed}");
        let scene_value = serde_json::to_value(&scene)
            .map_err(|source| RunError::Serialise { what: "the scene", source })?;
        let facts = json!({
            "program": hexadecimal(&self.program), "settings": settings_value(settings)?,
            "scene": scene_value,
        });
        let cache = EventCache::new(&self.cache, sha256(run::canonical(&facts).as_bytes()));
        if let Some(event) = cache.load(&name, seed) {
            return Ok(Some(event));
        }
        let begun = Instant::now();
        let mut steps = 0;
        let mut on_step = |_: &_| {
            steps += 1;
            self.progress.step();
            if requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let Some(event) = engine::simulate(&name, &scene, seed, settings, &mut on_step)? else {
            return Ok(None);
        };
        cache.store(&name, &event)?;
        let seconds = begun.elapsed().as_secs_f64();
        self.progress.event(steps, &format!("{name}: {steps} steps ({seconds:.1} s)"));
        Ok(Some(event))
    }
}

/// A scene in the reflection of the given index. Scenes that are already reflected were rejected before.
fn mirrored(scene: &Scene, index: usize) -> Scene {
    let flip = FLIPS[index % FLIPS.len()];
    flip.and_then(|flip| scene.mirrored(flip)).unwrap_or_else(|| scene.clone())
}
