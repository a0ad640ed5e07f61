//! Beliefs of the agents of an observed event, estimated from their reconstructed observations.

use phase_belief::overwrite;
use phase_event::ObservedEvent;
use phase_minds::{BeliefState, MindParameters, belief};
use phase_model::{
    AGENT_COUNT, Action, AgentId, BodySet, State,
    random::{self, Purpose},
};
use phase_perception::Observation;

/// One agent's belief at the end of every step, computed bottom-up: once for an event and shared by all
/// hypotheses. Forces play no part in it, since an agent observes the outcome of its own actions.
#[derive(Clone, Debug)]
pub struct EstimatedBeliefs {
    particles: Vec<Vec<State>>,
    last: Box<dyn BeliefState>,
}

impl EstimatedBeliefs {
    /// The beliefs of an agent along the states of an event (those of
    /// [`InverseDynamics`](crate::InverseDynamics)), by minds with these parameters.
    #[must_use]
    pub fn new(
        observed: &ObservedEvent,
        states: &[State],
        agent: AgentId,
        minds: &MindParameters,
        seed: u64,
    ) -> Self {
        let physics = observed.physics([0.0; AGENT_COUNT]);
        let mut random = random::stream(seed, Purpose::Belief, agent.number().into());
        let mut last = belief(observed.layout(), &physics, agent, minds, &states[0], &mut random);
        let mut particles = vec![last.particles().to_vec()];
        for state in &states[1..] {
            // Which action it was does not matter: its outcome is observed.
            let observation: Observation = last.observe(state);
            last.update(Action::NoForce, &observation, &mut random);
            particles.push(last.particles().to_vec());
        }
        Self { particles, last }
    }

    /// What the agent believes after the given number of steps if the world is in this state: from what it
    /// has observed until then in the event, and what it observes now. The particles, and the entities that
    /// it observes.
    #[must_use]
    pub fn belief_view(&self, step: usize, state: &State) -> (Vec<State>, BodySet) {
        let observation = self.last.observe(state);
        let known = &self.particles[step.min(self.particles.len() - 1)];
        let mut particles = known.clone();
        particles.iter_mut().for_each(|particle| overwrite(particle, &observation));
        (particles, observation.observed)
    }

    /// The belief after the last observed step, to continue from.
    #[must_use]
    pub fn last(&self) -> &dyn BeliefState {
        &*self.last
    }
}
