//! Beliefs of an agent in a recorded event, recomputed.

use crate::simulation::belief_stream;
use phase_belief::Belief;
use phase_event::Event;
use phase_forward::Forward;
use phase_model::{AgentId, State, arena::SUBSTEPS};
use phase_perception::{CellSet, observe};

/// The field of view and belief of one agent before one of its decisions.
#[derive(Clone, Debug)]
pub struct BeliefSnapshot {
    /// Cells in its field of view.
    pub visible: CellSet,
    /// Its particles.
    pub particles: Vec<State>,
}

/// The beliefs of an agent before each step of an event, and one more after the last. They depend only on its
/// observations and actions and on the event's seed, so this needs no planning.
#[must_use]
pub fn beliefs(event: &Event, agent: AgentId, particle_count: usize) -> Vec<BeliefSnapshot> {
    let physics = event.scene.physics();
    let dynamics = Forward::new(&physics);
    let mut random = belief_stream(event.seed, agent);
    let observation = observe(&physics, &event.initial, agent);
    let mut belief = Belief::new(&physics, &observation, particle_count, &mut random);
    let mut snapshots =
        vec![BeliefSnapshot { visible: observation.visible, particles: belief.particles().to_vec() }];
    for step in &event.steps {
        let observation = observe(&physics, &step.substeps[SUBSTEPS - 1], agent);
        belief.update(&dynamics, &physics, step.actions[agent], &observation, &mut random);
        snapshots
            .push(BeliefSnapshot { visible: observation.visible, particles: belief.particles().to_vec() });
    }
    snapshots
}
