//! One event of a `phase-events/1` file, in memory.

use crate::{Event, ObservedError, ObservedEvent, Tracking, Trajectory};
use phase_model::{AGENT_COUNT, Action, Relation, Scene, State};
use serde::Serialize;
use serde_json::Value;

/// The exact actions of a recording's first steps, where they are known.
#[derive(Clone, PartialEq, Debug)]
pub struct Recovered {
    /// The actions of both agents, by step.
    pub steps: Vec<[Action; AGENT_COUNT]>,
    /// The recording's remark on them.
    pub note: Option<String>,
}

/// The mover of an agent: a program or a person.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Controller {
    /// A program, or it is unknown.
    #[default]
    Mind,
    /// A person, who played.
    Human,
}

/// The part of a recording that only a simulated event has: all substeps, actions and thoughts, and how they
/// were made.
#[derive(Clone, PartialEq, Debug)]
pub struct SimulationRecord {
    /// The complete event.
    pub event: Event,
    /// The program that made it, such as `phase 0.1.0`.
    pub generator: String,
    /// The settings it was made with.
    pub settings: Value,
}

/// One event of a file, simulated or measured: its scene, labels and trajectory.
///
/// The scene holds goals and attitudes, which are labels too; a method is shown [`Recording::observed`],
/// which has none of them. A simulated event has its [`SimulationRecord`] beside the trajectory, and a
/// measured one may have the exact actions of its first steps.
///
/// `docs/reference/formats/events.md` describes every field of a file; [`Recording::from_json`] and
/// [`Recording::to_json`] are exact inverses.
#[derive(Clone, PartialEq, Debug)]
pub struct Recording {
    /// Name, unique among the events of a file.
    pub id: String,
    /// The scene, starting at row 0.
    pub scene: Scene,
    /// The intended relation.
    pub relation: Relation,
    /// The human judgement of the relation.
    pub relation_human: Option<Relation>,
    /// The meaning of row 0, in the recording's words.
    pub row_0: Option<String>,
    /// Steps that were recorded, which may exceed the number of rows.
    pub recorded_steps: Option<u32>,
    /// The movers of both agents.
    pub controllers: [Controller; AGENT_COUNT],
    /// The trajectories of all entities.
    pub trajectory: Trajectory,
    /// The actions of the first steps, where they are known for a measured event.
    pub recovered_actions: Option<Recovered>,
    /// The way in which it was measured, if it was read from a video or table.
    pub tracking: Option<Tracking>,
    /// The seed with which an event that is not yet simulated is to be simulated, so that several events can
    /// share their random draws. A simulated event has its seed in [`Recording::simulation`].
    pub seed: Option<u64>,
    /// All other data of a simulated event.
    pub simulation: Option<SimulationRecord>,
}

impl Recording {
    /// A simulated event as a recording: the rows are means over its substeps.
    #[must_use]
    pub fn of_event(id: impl Into<String>, event: Event, generator: String, settings: Value) -> Self {
        Self {
            id: id.into(),
            scene: event.scene.clone(),
            relation: event.scene.relation(),
            relation_human: None,
            row_0: Some("initial state".into()),
            recorded_steps: Some(event.steps.len() as u32),
            controllers: [Controller::Mind; AGENT_COUNT],
            trajectory: Trajectory::means(&event),
            recovered_actions: None,
            tracking: None,
            seed: None,
            simulation: Some(SimulationRecord { event, generator, settings }),
        }
    }

    /// The state of every frame of the event's video: the initial state, then five states a step. Those of a
    /// simulated event are exact; of a measured one, which has rows only, bodies go straight from row to row.
    #[must_use]
    pub fn frames(&self) -> Box<dyn Iterator<Item = State> + '_> {
        match &self.simulation {
            Some(simulation) => Box::new(simulation.event.frames().copied()),
            None => Box::new(self.trajectory.interpolated()),
        }
    }

    /// The part of the event that a viewer observes: no labels, and the same data for simulated as for
    /// measured events.
    ///
    /// # Errors
    /// [`ObservedError`] for recordings that cannot occur in a file.
    pub fn observed(&self) -> Result<ObservedEvent, ObservedError> {
        let rows = self.trajectory.states().iter().map(|state| state.bodies).collect();
        let observed = ObservedEvent::in_scene(&self.scene, rows)?;
        Ok(match &self.tracking {
            Some(tracking) => observed.with_tracking(tracking),
            None => observed,
        })
    }
}
