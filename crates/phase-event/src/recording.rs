//! One event of a `phase-events/1` file, in memory.

use crate::{Event, ObservedError, ObservedEvent, Trajectory};
use phase_model::{AGENT_COUNT, Action, Relation, Scene};
use serde_json::Value;

/// The exact actions of the first steps of a recording, where they are known.
#[derive(Clone, PartialEq, Debug)]
pub struct Recovered {
    /// The actions of both agents, by step.
    pub steps: Vec<[Action; AGENT_COUNT]>,
    /// What the recording says about them.
    pub note: Option<String>,
}

/// What a simulated event knows beyond a recording: all substeps, actions and thoughts.
#[derive(Clone, PartialEq, Debug)]
pub struct Simulation {
    /// The event, whole.
    pub event: Event,
    /// The program that made it, such as `phase 0.1.0`.
    pub generator: String,
    /// The settings it was made with.
    pub settings: Value,
}

/// One event: its scene, what its labels say, and where everybody went.
#[derive(Clone, PartialEq, Debug)]
pub struct Recording {
    /// Name, different for every event of a file.
    pub id: String,
    /// The scene, starting at row 0.
    pub scene: Scene,
    /// The intended relation.
    pub relation: Relation,
    /// The relation that human viewers saw.
    pub relation_human: Option<Relation>,
    /// What row 0 is, in the recording's words.
    pub row_0: Option<String>,
    /// Steps the recorder ran, which may be more than there are rows.
    pub recorded_steps: Option<u32>,
    /// Where everybody went.
    pub trajectory: Trajectory,
    /// The first actions, where they are known of a measured event.
    pub recovered_actions: Option<Recovered>,
    /// The seed that an event yet to be simulated is to be simulated with, so that several have the same chance. A
    /// simulated event has its seed in [`Recording::simulation`].
    pub seed: Option<u64>,
    /// Everything else, of a simulated event.
    pub simulation: Option<Simulation>,
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
            trajectory: Trajectory::means(&event),
            recovered_actions: None,
            seed: None,
            simulation: Some(Simulation { event, generator, settings }),
        }
    }

    /// What a viewer has of the event: none of its labels, and no more of a simulated event than of a measured one.
    ///
    /// # Errors
    /// [`ObservedError`] for recordings that no file can hold.
    pub fn observed(&self) -> Result<ObservedEvent, ObservedError> {
        let rows = self.trajectory.states().iter().map(|state| state.bodies).collect();
        let objects = self.scene.objects.iter().map(|object| object.size).collect();
        ObservedEvent::new(self.scene.layout, self.scene.agents.map(|agent| agent.size), objects, rows)
    }
}
