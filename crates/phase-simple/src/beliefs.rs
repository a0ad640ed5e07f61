//! Beliefs of the agents of an observed event, estimated from their reconstructed observations.

use crate::simulation_run::Outlook;
use phase_belief::overwrite;
use phase_event::ObservedEvent;
use phase_minds::{BeliefState, MindParameters, belief, belief_in, first_observation, observe};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Scene, State,
    arena::SUBSTEPS,
    random::{self, Pcg64Mcg, Purpose},
};
use phase_perception::Observation;

/// One agent's belief at the end of every step, computed bottom-up: once for an event and shared by all
/// hypotheses. Forces play no part in it, since an agent observes the outcome of its own actions.
#[derive(Clone, Debug)]
pub(crate) struct EstimatedBeliefs {
    /// After each step, with the state of the random stream.
    steps: Vec<(Box<dyn BeliefState>, Pcg64Mcg)>,
}

impl EstimatedBeliefs {
    /// The beliefs of an agent along the states of an event (those of
    /// [`InverseDynamics`](crate::InverseDynamics)), by minds with these parameters.
    #[must_use]
    pub(crate) fn new(
        observed: &ObservedEvent,
        states: &[State],
        agent: AgentId,
        minds: &MindParameters,
        seed: u64,
    ) -> Self {
        let physics = observed.physics([0.0; AGENT_COUNT]);
        let mut random = random::stream(seed, Purpose::Belief, agent.number().into());
        let seen = observe(minds.kind(), &physics, &states[0], agent);
        let first = belief(observed.layout(), &physics, minds, &seen, Some(&states[0]), &mut random);
        let mut beliefs = Self { steps: vec![(first, random)] };
        beliefs.follow(states, &[], 1);
        beliefs
    }

    /// The beliefs of an agent of a scene, with the senses that the scene gives it, after these actions of
    /// its own; otherwise as [`new`](Self::new).
    pub(crate) fn in_scene(
        scene: &Scene,
        states: &[State],
        actions: &[Action],
        agent: AgentId,
        minds: &MindParameters,
        seed: u64,
    ) -> Self {
        let mut random = random::stream(seed, Purpose::Belief, agent.number().into());
        let seen = first_observation(scene, minds.kind(), &states[0], agent);
        let first = belief_in(scene, minds, &seen, Some(&states[0]), &mut random);
        let mut beliefs = Self { steps: vec![(first, random)] };
        beliefs.follow(states, actions, 1);
        beliefs
    }

    /// Follows an event of which more has been observed, and of whose states so many, at least one, are what
    /// they were. `actions` are the agent's own. They matter only to an agent that infers the other's
    /// intent from what both do; where they are missing it is taken to apply no force.
    pub(crate) fn follow(&mut self, states: &[State], actions: &[Action], unchanged: usize) {
        self.steps.truncate(unchanged.max(1));
        for state in &states[self.steps.len()..] {
            let (mut belief, mut random) = self.steps[self.steps.len() - 1].clone();
            let action = actions.get(self.steps.len() - 1).copied().unwrap_or(Action::NoForce);
            let observation: Observation = belief.observe(state);
            let before = states[self.steps.len() - 1];
            belief.update(action, &observation, &between(&before, state), &mut random);
            self.steps.push((belief, random));
        }
    }

    /// The agent's belief after the given number of steps if the world is in this state: from what it
    /// has observed until then in the event, and what it observes now.
    #[must_use]
    pub(crate) fn outlook(&self, step: usize, state: &State) -> Outlook {
        let (known, _) = &self.steps[step.min(self.steps.len() - 1)];
        let observation = known.observe(state);
        let mut particles = known.particles().to_vec();
        particles.iter_mut().for_each(|particle| overwrite(particle, &observation));
        let suppositions = known.suppositions().to_vec();
        Outlook { particles, observed: observation.observed, contest: known.contest(), suppositions }
    }

    /// The belief at the end.
    pub(crate) fn last(&self) -> &dyn BeliefState {
        &*self.steps[self.steps.len() - 1].0
    }

    /// The belief after the given number of steps, to continue from.
    ///
    /// # Panics
    /// If the event has fewer steps.
    #[must_use]
    pub(crate) fn after(&self, step: usize) -> &dyn BeliefState {
        &*self.steps[step].0
    }
}

/// The states after the substeps of an observed step, bodies moved evenly from its start to its end.
fn between(before: &State, after: &State) -> [State; SUBSTEPS] {
    core::array::from_fn(|substep| {
        let share = (substep + 1) as f32 / SUBSTEPS as f32;
        let mut state = *after;
        for (body, from) in state.bodies.iter_mut().zip(&before.bodies) {
            body.position = from.position.lerp(body.position, share);
            body.angle = from.angle + (body.angle - from.angle) * share;
        }
        state
    })
}
