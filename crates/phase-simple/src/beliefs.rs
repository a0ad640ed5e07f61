//! Beliefs of the agents of an observed event, estimated from their reconstructed observations.

use phase_belief::{Belief, overwrite};
use phase_event::ObservedEvent;
use phase_forward::Forward;
use phase_model::{
    AGENT_COUNT, Action, AgentId, BodySet, PhysicsConfig, State,
    random::{self, Purpose},
};
use phase_perception::{Observation, observe};

/// One agent's belief at the end of every step, computed bottom-up: once for an event and shared by all
/// hypotheses. Forces play no part in it, since an agent observes the outcome of its own actions.
#[derive(Clone, Debug)]
pub struct EstimatedBeliefs {
    particles: Vec<Vec<State>>,
    last: Belief,
}

impl EstimatedBeliefs {
    /// The beliefs of an agent along the states of an event (those of
    /// [`InverseDynamics`](crate::InverseDynamics)), with at least this number of particles.
    #[must_use]
    pub fn new(
        observed: &ObservedEvent,
        states: &[State],
        agent: AgentId,
        particle_count: usize,
        seed: u64,
    ) -> Self {
        let physics = observed.physics([0.0; AGENT_COUNT]);
        let dynamics = Forward::new(&physics);
        let mut random = random::stream(seed, Purpose::Belief, agent.number().into());
        let seen: Vec<Observation> = states.iter().map(|state| observe(&physics, state, agent)).collect();
        let mut last = Belief::new(&physics, &seen[0], particle_count, &mut random);
        let mut particles = vec![last.particles().to_vec()];
        for observation in &seen[1..] {
            // Which action it was does not matter: its outcome is observed.
            last.update(&dynamics, &physics, Action::NoForce, observation, &mut random);
            particles.push(last.particles().to_vec());
        }
        Self { particles, last }
    }

    /// What the agent believes after the given number of steps if the world is in this state: from what it
    /// has observed until then in the event, and what it observes now. The particles, and the entities that
    /// it observes.
    #[must_use]
    pub fn belief_view(&self, physics: &PhysicsConfig, step: usize, state: &State) -> (Vec<State>, BodySet) {
        let observation = observe(physics, state, self.last.agent());
        let known = &self.particles[step.min(self.particles.len() - 1)];
        let mut particles = known.clone();
        particles.iter_mut().for_each(|particle| overwrite(particle, &observation));
        (particles, observation.observed)
    }

    /// The belief after the last observed step, to continue from.
    #[must_use]
    pub const fn last(&self) -> &Belief {
        &self.last
    }
}
