//! Everything that is known of events: what they hold, and what is simulated for questions about them.

use super::kept::Kept;
use crate::{
    engine,
    error::RunError,
    interrupt,
    laboratory::unusable,
    source::{self, EventInput, track},
};
use phase_dataset::{
    manifest::{MANIFEST_FILE, Manifest},
    splits::Split,
};
use phase_event::SimulationRecord;
use phase_evidence::Track;
use phase_model::{AgentId, Attitude, State};
use phase_questions::{
    Alternative, Facts, Inside, SimulatedFutures, asks_without, believed_rooms, foreseen, idle_of,
    is_about_beliefs,
};
use phase_sim::{Simulation, SimulationSettings};
use std::{
    collections::{BTreeMap, BTreeSet},
    path::{Path, PathBuf},
};

/// Futures that are simulated from one state.
const FUTURES: usize = 4;
/// Steps that they last: four seconds of video.
const FUTURE_STEPS: usize = 16;
/// Most simulations of a search in them.
const FUTURE_SIMULATIONS: usize = 200;

/// Events that belong together: one, or those of a set.
#[derive(Debug)]
pub(super) struct Unit {
    pub(super) set: Option<String>,
    /// Indices in the source.
    pub(super) events: Vec<usize>,
}

/// Checks that events are divided into training, validation and test if one part of them is wanted.
pub(super) fn check_split(events: &[PathBuf], split: Option<Split>) -> Result<(), RunError> {
    let Some(split) = split else { return Ok(()) };
    let divided = events.iter().map(|path| is_divided(path));
    if divided.collect::<Result<Vec<_>, _>>()?.contains(&true) {
        return Ok(());
    }
    Err(unusable(&events[0], &format!("has no {} events: it is not divided", split.name())))
}

/// Whether the events of a folder are divided into training, validation and test.
fn is_divided(path: &Path) -> Result<bool, RunError> {
    let manifest = path.join(MANIFEST_FILE);
    Ok(manifest.is_file() && Manifest::read(&manifest)?.events.iter().any(|event| event.split.is_some()))
}

/// The units of a dataset or file, in its order; of a dataset with splits only the events of one.
pub(super) fn units(path: &Path, source: &EventInput, split: Option<Split>) -> Result<Vec<Unit>, RunError> {
    let manifest = path.join(MANIFEST_FILE);
    let mut sets = BTreeMap::new();
    let mut left_out = BTreeSet::new();
    if manifest.is_file() {
        for event in Manifest::read(&manifest)?.events {
            if split.is_some() && event.split.is_some() && event.split != split {
                left_out.insert(event.id.clone());
            }
            if let Some(place) = event.set {
                sets.insert(event.id, place.set);
            }
        }
    }
    let mut units: Vec<Unit> = Vec::new();
    for index in (0..source.len()).filter(|&index| !left_out.contains(source.id(index))) {
        let set = sets.get(source.id(index)).cloned();
        match units.last_mut() {
            Some(last) if set.is_some() && last.set == set => last.events.push(index),
            _ => units.push(Unit { set, events: vec![index] }),
        }
    }
    Ok(units)
}

/// The facts of a unit; `None` if interrupted. Its events share simulations without the agent that differs.
pub(super) fn of_unit(
    path: &Path,
    source: &EventInput,
    unit: &Unit,
    ratings: &BTreeMap<String, [usize; 3]>,
    kept: &Kept,
) -> Result<Option<Vec<Facts>>, RunError> {
    let mut known: Vec<(AgentId, phase_model::Scene, Track)> = Vec::new();
    let mut all = Vec::with_capacity(unit.events.len());
    for &index in &unit.events {
        let recording = source.load(index)?;
        let mut facts = Facts {
            id: recording.id.clone(),
            set: unit.set.clone(),
            scene: recording.scene.clone(),
            track: track(&recording),
            inside: None,
            ratings: ratings.get(&recording.id).copied(),
        };
        if let Some(simulation) = &recording.simulation {
            let (seed, states) = (simulation.event.seed, Inside::states_of(&simulation.event));
            facts.inside = kept.inside(&facts.id, seed, &facts.track.physics, states);
            if facts.inside.is_none() {
                let settings = source::settings(path, &recording.id, simulation)?;
                let inside = inside(&facts, simulation, &settings, &mut known)?;
                let Some(inside) = inside else { return Ok(None) };
                kept.keep_inside(&facts.id, seed, &inside)?;
                facts.inside = Some(inside);
            }
        }
        all.push(facts);
    }
    Ok(Some(all))
}

fn inside(
    facts: &Facts,
    simulation: &SimulationRecord,
    settings: &SimulationSettings,
    known: &mut Vec<(AgentId, phase_model::Scene, Track)>,
) -> Result<Option<Inside>, RunError> {
    let event = &simulation.event;
    let objects = event.scene.objects.len();
    let beliefs =
        AgentId::ALL.map(|agent| believed_rooms(&phase_sim::beliefs(event, agent, &settings.minds), objects));
    if is_about_beliefs(&event.scene) {
        // Nothing else is asked about these.
        let states = Inside::states_of(event);
        return Ok(Some(Inside { states, beliefs, without: None, futures: None }));
    }
    let idle = idle_of(facts);
    // What an idle agent wants makes no difference.
    let mut scene = event.scene.clone();
    scene.agents[idle].attitude = Attitude::Neutral;
    scene.agents[idle].goal = scene.agents[idle.other()].goal;
    let same = known.iter().find(|(agent, other, _)| *agent == idle && *other == scene);
    let without = if !asks_without(facts, idle) {
        None
    } else if let Some((_, _, track)) = same {
        Some(track.clone())
    } else {
        let settings = SimulationSettings { idle: Some(idle), ..*settings };
        let go_on = &mut |_: &phase_event::Step| interrupt::goes_on();
        let idle_scene = {
            let mut scene = event.scene.clone();
            scene.agents[idle].attitude = Attitude::Neutral;
            scene
        };
        let Some(event) = engine::simulate(&facts.id, &idle_scene, event.seed, &settings, go_on)? else {
            return Ok(None);
        };
        let track = Track::of_event(&event);
        known.push((idle, scene, track.clone()));
        Some(track)
    };
    let without = without.map(|track| Alternative { idle, track });
    let states = Inside::states_of(event);
    let Some(futures) = futures(facts, &states, simulation, settings)? else { return Ok(None) };
    Ok(Some(Inside { states, beliefs, without, futures }))
}

/// Four futures of an event from its middle, each with other random numbers; both minds have perceived the
/// first half.
///
/// Returns `None` if it was interrupted, and `Some(None)` if no question can follow: the event is too short,
/// or no entity leaves its room in the event and in all futures. (Questions about entities that stay need
/// such an entity beside them.)
fn futures(
    facts: &Facts,
    states: &[State],
    simulation: &SimulationRecord,
    settings: &SimulationSettings,
) -> Result<Option<Option<SimulatedFutures>>, RunError> {
    let event = &simulation.event;
    let cut = event.steps.len() / 2;
    if cut == 0 || cut + FUTURE_STEPS > event.steps.len() {
        return Ok(Some(None));
    }
    let mut futures = SimulatedFutures { step: cut, steps: FUTURE_STEPS, ends: Vec::with_capacity(FUTURES) };
    let something_leaves = |futures: &SimulatedFutures| {
        foreseen(facts, states, futures).iter().any(|(_, now, room)| now != room)
    };
    if !something_leaves(&futures) {
        return Ok(Some(None));
    }
    let fail = |source| RunError::Simulation { id: facts.id.clone(), source };
    let never = usize::MAX;
    let settings = SimulationSettings {
        max_steps: cut + FUTURE_STEPS,
        rest_steps: never,
        still_steps: never,
        minds: settings.minds.with_simulations(FUTURE_SIMULATIONS),
        ..*settings
    };
    let mut past = Simulation::new(&event.scene, event.seed, &settings).map_err(fail)?;
    for step in &event.steps[..cut] {
        past.step(step.actions.map(Some)).map_err(fail)?;
    }
    for k in 0..FUTURES {
        let mut future = past.branch(engine::event_seed(event.seed, 1 + k));
        while !future.is_over() {
            if interrupt::requested() {
                return Ok(None);
            }
            future.step([None; 2]).map_err(fail)?;
        }
        futures.ends.push(*future.state());
        if !something_leaves(&futures) {
            return Ok(Some(None));
        }
    }
    Ok(Some(Some(futures)))
}
