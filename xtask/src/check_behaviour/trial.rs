//! Playing one scene once, and once more without the agent that matters.

use super::{judge, report::Trial, rows::Part};
use core::ops::ControlFlow;
use phase_cli::{
    console,
    context::Context,
    engine,
    error::CliError,
    interrupt,
    production::{self, settings_value},
    progress::Progress,
};
use phase_dataset::{cache::Cache, checksum::sha256, folder::Folder};
use phase_event::Event;
use phase_evidence::Track;
use phase_model::{AgentId, Attitude, Flip, Scene};
use phase_sim::Settings;
use std::{path::PathBuf, time::Instant};

/// The mirrors that seeds take in turn.
const FLIPS: [Option<Flip>; 5] =
    [None, Some(Flip::UpDown), Some(Flip::LeftRight), Some(Flip::Diagonal), Some(Flip::AntiDiagonal)];

/// Where events are played, or taken from a run that was broken off.
#[derive(Debug)]
pub(super) struct Laboratory {
    settings: Settings,
    cache: PathBuf,
    program: [u8; 32],
    progress: Progress,
}

/// The name of a part that no other has: parts may share scenes.
pub(super) fn key(part: &Part) -> String {
    part.lambda.map_or_else(|| part.name.into(), |lambda| format!("{}-lambda{lambda}", part.name))
}

impl Laboratory {
    pub(super) fn new(folder: &Folder, settings: Settings, events: usize, context: &Context) -> Self {
        let program = production::program();
        let progress =
            context.progress(&format!("simulating {}", console::events(events)), events, settings.max_steps);
        Self { settings, cache: folder.cache(), program, progress }
    }

    /// Plays a scene with the seed of this index and judges it; `None` if interrupted.
    pub(super) fn trial(
        &self,
        part: &Part,
        id: &str,
        scene: &Scene,
        index: usize,
    ) -> Result<Option<Trial>, CliError> {
        let Some(event) = self.event(part, id, scene, index)? else { return Ok(None) };
        let control = match part.control {
            Some(agent) => {
                let Some(control) = self.control(part, id, scene, index, agent)? else { return Ok(None) };
                Some(Track::of_event(&control))
            }
            None => None,
        };
        let verdict = judge::judge(part, &event.scene, &Track::of_event(&event), control.as_ref());
        let flip = event.scene.layout.flip();
        Ok(Some(Trial { seed: event.seed, flip, steps: event.steps.len(), verdict }))
    }

    /// The event of a scene and the seed of this index.
    pub(super) fn event(
        &self,
        part: &Part,
        id: &str,
        scene: &Scene,
        index: usize,
    ) -> Result<Option<Event>, CliError> {
        let settings = self.settings_of(part);
        self.play(&format!("{}.{id}", key(part)), mirrored(scene, index), index, &settings)
    }

    /// The same without an agent's doing: it is neutral and stays where it is.
    fn control(
        &self,
        part: &Part,
        id: &str,
        scene: &Scene,
        index: usize,
        agent: AgentId,
    ) -> Result<Option<Event>, CliError> {
        let mut scene = mirrored(scene, index);
        scene.agents[agent].attitude = Attitude::Neutral;
        let settings = Settings { idle: Some(agent), ..self.settings_of(part) };
        self.play(&format!("{}.{id}.without{agent}", key(part)), scene, index, &settings)
    }

    fn settings_of(&self, part: &Part) -> Settings {
        let mut settings = Settings { idle: part.idle, ..self.settings };
        if part.lingers {
            settings.rest_steps = usize::MAX;
        }
        if let Some(lambda) = part.lambda {
            settings.minds.lambda = lambda;
        }
        settings
    }

    fn play(
        &self,
        name: &str,
        scene: Scene,
        index: usize,
        settings: &Settings,
    ) -> Result<Option<Event>, CliError> {
        let seed = index as u64 + 1;
        let name = format!("{name}.{seed}");
        let key = format!("{} {scene:?}", settings_value(settings)?);
        let cache = Cache::new(&self.cache, sha256(&[&self.program[..], key.as_bytes()].concat()));
        if let Some(event) = cache.load(&name, seed) {
            return Ok(Some(event));
        }
        let begun = Instant::now();
        let mut steps = 0;
        let mut on_step = |_: &_| {
            steps += 1;
            self.progress.step();
            if interrupt::requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
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

/// A scene in the mirror whose turn it is. Scenes that are mirrored already were refused before.
fn mirrored(scene: &Scene, index: usize) -> Scene {
    let flip = FLIPS[index % FLIPS.len()];
    flip.and_then(|flip| scene.mirrored(flip)).unwrap_or_else(|| scene.clone())
}
