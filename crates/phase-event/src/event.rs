//! A social event: the result of a simulation.

use crate::Thought;
use phase_model::{AGENT_COUNT, Action, Scene, State, arena::SUBSTEPS};

/// One step of an event, a quarter of a second of video: the actions of both agents, their explanations and
/// the resulting states.
///
/// Both agents choose at the same time, from the state before the step, and hold their action for all of its
/// substeps.
#[derive(Clone, PartialEq, Debug)]
pub struct Step {
    /// The actions of both agents.
    pub actions: [Action; AGENT_COUNT],
    /// The explanations of the actions.
    pub thoughts: [Thought; AGENT_COUNT],
    /// The state after each substep of 1/60 s; the last is the state after the step.
    pub substeps: [State; SUBSTEPS],
}

/// A simulated social event: a scene and everything that happened in it.
///
/// The scene, the seed and the settings of a simulation determine an event, bit for bit.
/// [`Recording::of_event`] turns it into a recording, as files hold it; a recording of measured motion has no
/// `Event`.
///
/// [`Recording::of_event`]: crate::Recording::of_event
#[derive(Clone, PartialEq, Debug)]
pub struct Event {
    /// The scene.
    pub scene: Scene,
    /// The random seed of the event.
    pub seed: u64,
    /// The state before the first step.
    pub initial: State,
    /// The steps, in order.
    pub steps: Vec<Step>,
}

impl Event {
    /// The initial state and the state after every substep: one frame of video each.
    pub fn frames(&self) -> impl Iterator<Item = &State> {
        core::iter::once(&self.initial).chain(self.steps.iter().flat_map(|step| &step.substeps))
    }
}
