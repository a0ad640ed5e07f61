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
use std::sync::OnceLock;

/// One agent's belief at the end of every step, computed bottom-up: once for an event and shared by all
/// hypotheses. Forces play no part in it, since an agent observes the outcome of its own actions.
#[derive(Clone, Debug)]
pub(crate) struct EstimatedBeliefs {
    /// At the start and after each step but the last.
    steps: Vec<Estimate>,
    /// After the last step, if there is one. It matters only to who asks for it, and the next row may show
    /// the state in another light.
    last: Option<LastEstimate>,
}

/// A belief, with the state of the random stream.
type Estimate = (Box<dyn BeliefState>, Pcg64Mcg);

/// The belief after the last step, once somebody has asked for it.
#[derive(Clone, Debug)]
struct LastEstimate {
    action: Action,
    states: [State; 2],
    estimate: OnceLock<Estimate>,
}

/// The belief after a step from one state to another.
fn after((belief, random): &Estimate, action: Action, [before, state]: &[State; 2]) -> Estimate {
    let mut belief = belief.clone();
    let mut random = random.clone();
    let observation: Observation = belief.observe(state);
    belief.update(action, &observation, &between(before, state), &mut random);
    (belief, random)
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
        let mut beliefs = Self { steps: vec![(first, random)], last: None };
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
        let mut beliefs = Self { steps: vec![(first, random)], last: None };
        beliefs.follow(states, actions, 1);
        beliefs
    }

    /// Follows an event of which more has been observed, and of whose states so many, at least one, are what
    /// they were. `actions` are the agent's own. They matter only to an agent that infers the other's
    /// intent from what both do; where they are missing it is taken to apply no force.
    pub(crate) fn follow(&mut self, states: &[State], actions: &[Action], unchanged: usize) {
        self.steps.truncate(unchanged.max(1));
        self.last = None;
        for step in self.steps.len()..states.len() {
            let action = actions.get(step - 1).copied().unwrap_or(Action::NoForce);
            let states_of_step = [states[step - 1], states[step]];
            if step + 1 < states.len() {
                self.steps.push(after(&self.steps[step - 1], action, &states_of_step));
            } else {
                self.last = Some(LastEstimate { action, states: states_of_step, estimate: OnceLock::new() });
            }
        }
    }

    /// The estimate after so many steps, or after the last.
    fn estimate(&self, step: usize) -> &Estimate {
        let before = &self.steps[self.steps.len() - 1];
        match &self.last {
            Some(LastEstimate { action, states, estimate }) if step >= self.steps.len() => {
                estimate.get_or_init(|| after(before, *action, states))
            }
            _ => self.steps.get(step).unwrap_or(before),
        }
    }

    /// The agent's belief after the given number of steps if the world is in this state: from what it
    /// has observed until then in the event, and what it observes now.
    #[must_use]
    pub(crate) fn outlook(&self, step: usize, state: &State) -> Outlook {
        let (known, _) = self.estimate(step);
        let observation = known.observe(state);
        let mut particles = known.particles().to_vec();
        particles.iter_mut().for_each(|particle| overwrite(particle, &observation));
        let suppositions = known.suppositions().to_vec();
        Outlook { particles, observed: observation.observed, contest: known.contest(), suppositions }
    }

    /// The belief at the end.
    pub(crate) fn last(&self) -> &dyn BeliefState {
        &*self.estimate(usize::MAX).0
    }

    /// The belief after the given number of steps, or after the last, to continue from.
    #[must_use]
    pub(crate) fn after(&self, step: usize) -> &dyn BeliefState {
        &*self.estimate(step).0
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
