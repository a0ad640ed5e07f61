//! Deriving again what an event's file says: its motion from its actions, its video from its motion, and all
//! of it from its seed.

use super::{Checks, derived, origin::Origin};
use crate::{
    engine,
    error::RunError,
    event_writer::{settings_value, video},
    gen_dataset::scenes::Scenes,
    listener::{Listener, Silent},
    parallel::make_all,
    picture::{self, Look},
    words,
};
use core::ops::ControlFlow;
use phase_dataset::{
    event_set::SetEntry,
    manifest::{EventEntry, MANIFEST_FILE, Manifest},
    phase_events,
};
use phase_event::{Event, EventReadError, Recording, SimulationRecord};
use phase_files::{
    FileError, Problem,
    checksum::{FileEntry, sha256_hex},
};
use phase_model::{AGENT_COUNT, PhysicsConfig, State, json::FieldError};
use phase_sim::SimulationSettings;
use std::path::Path;

/// Everything in a dataset that is not what follows from its actions and from its preset.
pub(super) fn problems(
    folder: &Path,
    manifest: &Manifest,
    checks: &Checks,
    threads: usize,
    listener: &dyn Listener,
) -> Result<Vec<FileError>, RunError> {
    let origin = match Origin::of(folder, manifest, checks) {
        Ok(origin) => origin,
        Err(problems) => return Ok(problems),
    };
    let look = match Look::of(&manifest.form) {
        Ok(look) => look,
        Err(error) => {
            let problem = Problem::Shape { what: "dataset manifest", rule: error.to_string() };
            return Ok(vec![FileError { file: folder.join(MANIFEST_FILE), problem }]);
        }
    };
    let scenes = origin.scenes();
    let count = manifest.events.len();
    let progress = listener.progress_over(&format!("replaying {}", words::events(count)), count);
    let mut problems = over(threads, count, |k| {
        let problem = event((folder, &look), &manifest.events[k], k, &origin, &scenes);
        progress.steps(1);
        problem
    })?;
    problems
        .extend(over(threads, manifest.sets.len(), |k| set((folder, &look), manifest, &manifest.sets[k]))?);
    drop(progress);
    if problems.is_empty() {
        problems = derived::problems(folder, manifest, &Silent)?;
    }
    Ok(problems)
}

/// The problems that a check of each of several things finds.
fn over(
    threads: usize,
    count: usize,
    check: impl Fn(usize) -> Result<(), FileError> + Sync,
) -> Result<Vec<FileError>, RunError> {
    let answers = make_all(threads, count, |k| Ok(Some(check(k).err())))?;
    let answers = answers.ok_or(RunError::Stopped(None))?;
    Ok(answers.into_iter().flatten().collect())
}

/// One event, by its index.
fn event(
    (folder, look): (&Path, &Look),
    entry: &EventEntry,
    index: usize,
    origin: &Origin,
    scenes: &Scenes<'_>,
) -> Result<(), FileError> {
    let recorded = Recorded::read(folder, entry)?;
    let settings = recorded.settings()?;
    recorded.check_motion(&settings)?;
    let found = origin.check(scenes, index, entry, &recorded.simulation.event, &settings);
    found.map_err(|(field, rule)| recorded.fail(field, rule))?;
    recorded.check_thoughts(&settings)?;
    match &entry.video {
        Some(file) => check_video(folder, file, video(&entry.id, &recorded.simulation.event, look)),
        None => Ok(()),
    }
}

/// The video of a set.
fn set((folder, look): (&Path, &Look), manifest: &Manifest, set: &SetEntry) -> Result<(), FileError> {
    let Some(file) = &set.video else { return Ok(()) };
    let of_set = |entry: &&EventEntry| entry.set.as_ref().is_some_and(|place| place.set == set.id);
    let members = manifest.events.iter().filter(of_set).map(|entry| Recorded::read(folder, entry));
    let members = members.collect::<Result<Vec<_>, _>>()?;
    let events: Vec<&Event> = members.iter().map(|recorded| &recorded.simulation.event).collect();
    check_video(folder, file, picture::beside(&set.id, &events, look))
}

fn check_video(folder: &Path, entry: &FileEntry, drawn: Result<Vec<u8>, RunError>) -> Result<(), FileError> {
    let differs = |what: String| FileError { file: entry.place(folder), problem: Problem::Differs(what) };
    let drawn = drawn.map_err(|error| differs(format!("its event, which cannot be drawn: {error}")))?;
    let same = sha256_hex(&drawn) == entry.sha256;
    if same { Ok(()) } else { Err(differs("the video of its event, drawn again".into())) }
}

/// Simulates some events again, by index; those whose files have other bytes.
pub(super) fn simulated_again(
    folder: &Path,
    manifest: &Manifest,
    events: &[usize],
    threads: usize,
    listener: &dyn Listener,
) -> Result<Vec<FileError>, RunError> {
    let count = events.len();
    let progress = listener.progress_over(&format!("simulating {} again", words::events(count)), count);
    let answers = make_all(threads, count, |k| {
        let answer = simulate(folder, &manifest.events[events[k]]);
        progress.steps(1);
        answer
    })?;
    let answers = answers.ok_or(RunError::Stopped(None))?;
    Ok(answers.into_iter().flatten().collect())
}

/// Simulates an event again: the problem found, if any; `None` if interrupted.
fn simulate(folder: &Path, entry: &EventEntry) -> Result<Option<Option<FileError>>, RunError> {
    let (recorded, settings) = match Recorded::read(folder, entry).and_then(|it| Ok((it.settings()?, it))) {
        Ok((settings, recorded)) => (recorded, settings),
        Err(error) => return Ok(Some(Some(error))),
    };
    let SimulationRecord { event, generator, settings: value } = &recorded.simulation;
    let again =
        engine::simulate(&entry.id, &event.scene, event.seed, &settings, &mut |_| ControlFlow::Continue(()));
    let Some(again) = again? else { return Ok(None) };
    let again = Recording::of_event(entry.id.as_str(), again, generator.clone(), value.clone());
    let same = sha256_hex(phase_event::to_json(&[again])?.as_bytes()) == entry.event.sha256;
    let problem = Problem::Differs("the event simulated again from its scene, seed and settings".into());
    Ok(Some((!same).then(|| FileError { file: entry.event.place(folder), problem })))
}

/// A simulated event as its file has it.
struct Recorded<'a> {
    folder: &'a Path,
    entry: &'a EventEntry,
    simulation: SimulationRecord,
}

impl<'a> Recorded<'a> {
    fn read(folder: &'a Path, entry: &'a EventEntry) -> Result<Self, FileError> {
        let file = entry.event.place(folder);
        let recordings = phase_events::read(&file)?;
        let simulation = recordings.into_iter().find_map(|recording| recording.simulation);
        match simulation {
            Some(simulation) => Ok(Self { folder, entry, simulation }),
            None => {
                let rule = "it was not simulated".into();
                Err(FileError { file, problem: Problem::Shape { what: "event of a dataset", rule } })
            }
        }
    }

    fn fail(&self, field: &str, rule: String) -> FileError {
        let problem = FieldError { field: field.into(), rule };
        let problem = Problem::content(EventReadError::Field { event: Some(self.entry.id.clone()), problem });
        FileError { file: self.entry.event.place(self.folder), problem }
    }

    /// The settings, all of whose members have to have a meaning.
    fn settings(&self) -> Result<SimulationSettings, FileError> {
        let found = &self.simulation.settings;
        let settings = SimulationSettings::read(found, "settings")
            .map_err(|error| self.fail(&error.field, error.rule))?;
        match settings_value(&settings) {
            Ok(value) if value == *found => Ok(settings),
            _ => Err(self.fail("settings", "holds what is no setting, or lacks one".into())),
        }
    }

    /// Whether the motion is that of the actions in the engine that the settings name, from the start of the
    /// scene.
    fn check_motion(&self, settings: &SimulationSettings) -> Result<(), FileError> {
        let Event { scene, initial, steps, .. } = &self.simulation.event;
        let physics = scene.physics();
        let again = phase_sim::replay(&self.simulation.event, settings);
        if !same(&physics, initial, &scene.initial_state()) {
            return Err(self.fail("substeps", "does not begin at the start of the scene".into()));
        }
        for (number, (step, states)) in (1..).zip(steps.iter().zip(again)) {
            if !states.iter().zip(&step.substeps).all(|(again, found)| same(&physics, again, found)) {
                let engine = settings.engine.name();
                let rule =
                    format!("is not what the actions lead to in the engine `{engine}` in step {number}");
                return Err(self.fail("substeps", rule));
            }
        }
        let length = steps.len();
        if length > settings.max_steps || length < settings.min_steps.min(settings.max_steps) {
            let min = settings.min_steps;
            let max = settings.max_steps;
            return Err(self.fail("trajectory", format!("has {length} steps, not {min} to {max}")));
        }
        Ok(())
    }

    /// Whether thoughts can be those of minds with these settings: how often particles and simulations are
    /// counted.
    fn check_thoughts(&self, settings: &SimulationSettings) -> Result<(), FileError> {
        for (number, step) in (1..).zip(&self.simulation.event.steps) {
            for (agent, thought) in step.thoughts.iter().enumerate() {
                let rule = |what: &str| format!("has {what} in step {number} of agent {agent}");
                let particles: usize = thought.subgoals.iter().map(|it| it.particles).sum();
                if particles > settings.minds.particles() {
                    return Err(self.fail("thoughts", rule("more particles than the belief")));
                }
                let searched = thought.actions.iter().any(|it| it.action == step.actions[agent]);
                if !searched && !thought.actions.is_empty() {
                    return Err(self.fail("thoughts", rule("no search of the action taken")));
                }
            }
        }
        Ok(())
    }
}

/// Whether two states are the same, bit for bit, in everything that a scene has.
fn same(physics: &PhysicsConfig, a: &State, b: &State) -> bool {
    let bits = |state: &State, entity| {
        let body = state.body(entity);
        let numbers = [body.position.x, body.position.y, body.velocity.x, body.velocity.y];
        (numbers.map(f32::to_bits), [body.angle, body.angular_velocity].map(f32::to_bits))
    };
    let grip = |state: &State, agent: usize| {
        state.grips[agent].map(|grip| (grip.object, grip.side, grip.relative_angle.to_bits()))
    };
    physics.entities().all(|entity| bits(a, entity) == bits(b, entity))
        && (0..AGENT_COUNT).all(|agent| grip(a, agent) == grip(b, agent))
        && a.contacts == b.contacts
}
