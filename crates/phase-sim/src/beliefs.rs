//! Beliefs of an agent in a recorded event, recomputed.

use crate::simulation::belief_stream;
use phase_event::Event;
use phase_minds::{MindParameters, belief, observe};
use phase_model::{AgentId, State, arena::SUBSTEPS};
use phase_perception::CellSet;

/// The field of view and belief of one agent before one of its decisions.
#[derive(Clone, Debug)]
pub struct BeliefSnapshot {
    /// Cells in its field of view.
    pub visible: CellSet,
    /// Its particles.
    pub particles: Vec<State>,
}

/// The beliefs of an agent before each step of an event, and one more after the last.
///
/// They depend on the agent's observations and actions and on the event's seed alone, so that this needs no
/// planning. `minds` are the parameters that the event was simulated with; with others, the beliefs are those
/// that such a mind would have had.
#[must_use]
pub fn beliefs(event: &Event, agent: AgentId, minds: &MindParameters) -> Vec<BeliefSnapshot> {
    let physics = event.scene.physics();
    let mut random = belief_stream(event.seed, agent);
    let first = observe(minds.kind(), &physics, &event.initial, agent);
    let mut belief = belief(event.scene.layout, &physics, minds, &first, Some(&event.initial), &mut random);
    let mut snapshots =
        vec![BeliefSnapshot { visible: first.visible, particles: belief.particles().to_vec() }];
    for step in &event.steps {
        let observation = belief.observe(&step.substeps[SUBSTEPS - 1]);
        belief.update(step.actions[agent], &observation, &step.substeps, &mut random);
        snapshots
            .push(BeliefSnapshot { visible: observation.visible, particles: belief.particles().to_vec() });
    }
    snapshots
}
