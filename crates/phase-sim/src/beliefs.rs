//! Beliefs of an agent in a recorded event, recomputed.

use crate::minds::belief_stream;
use phase_event::Event;
use phase_minds::{
    BeliefState, BeliefView, Contest, MindParameters, Supposition, belief_in, first_observation,
};
use phase_model::{AgentId, BodySet, State, arena::SUBSTEPS};
use phase_perception::{CellSet, Observation};

/// The field of view and belief of one agent before one of its decisions.
#[derive(Clone, Debug)]
pub struct BeliefSnapshot {
    /// Cells in its field of view.
    pub visible: CellSet,
    /// The entities that it observes, itself included.
    pub observed: BodySet,
    /// Its particles.
    pub particles: Vec<State>,
    /// For each particle what it supposes of the other; empty if the agent knows the other's goal.
    pub suppositions: Vec<Supposition>,
    /// Its memory of a contest for an object.
    pub contest: Contest,
}

/// The beliefs of an agent before each step of an event, and one more after the last.
///
/// They depend on the agent's observations and actions and on the event's seed alone, so that this needs no
/// planning. `minds` are the parameters that the event was simulated with; with others, the beliefs are those
/// that such a mind would have had.
#[must_use]
pub fn beliefs(event: &Event, agent: AgentId, minds: &MindParameters) -> Vec<BeliefSnapshot> {
    let mut random = belief_stream(event.seed, agent);
    let first = first_observation(&event.scene, minds.kind(), &event.initial, agent);
    let mut belief = belief_in(&event.scene, minds, &first, Some(&event.initial), &mut random);
    let snapshot = |observation: &Observation, belief: &dyn BeliefState| BeliefSnapshot {
        visible: observation.visible,
        observed: observation.observed,
        particles: belief.particles().to_vec(),
        suppositions: belief.suppositions().to_vec(),
        contest: belief.contest(),
    };
    let mut snapshots = vec![snapshot(&first, &*belief)];
    for step in &event.steps {
        let observation = belief.observe(&step.substeps[SUBSTEPS - 1]);
        belief.update(step.actions[agent], &observation, &step.substeps, &mut random);
        snapshots.push(snapshot(&observation, &*belief));
    }
    snapshots
}

/// The belief that an agent's decision in a step was based on, by its [`beliefs`].
///
/// # Panics
/// If the event has no such step.
#[must_use]
pub fn belief_view<'a>(
    event: &Event,
    agent: AgentId,
    step: usize,
    beliefs: &'a [BeliefSnapshot],
) -> BeliefView<'a> {
    let BeliefSnapshot { observed, particles, suppositions, contest, .. } = &beliefs[step];
    let last_action = step.checked_sub(1).map(|last| event.steps[last].actions[agent]);
    BeliefView { particles, suppositions, observed: *observed, last_action, contest: *contest }
}
