//! The generative model that POMCP searches: the agent's own model of the world.

use crate::{
    Foresight,
    objective::{ARENA_DIAGONAL, Objective},
    rollout_policy,
    steering::Steering,
};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Attitude, Dynamics, Entity, Goal, Literal, PhysicsConfig, State, Subgoal,
    reward,
};
use phase_perception::observed_set;
use phase_planner::Routes;
use phase_pomcp::{GenerativeModel, Transition};
use phase_predicates::achieved;
use rand::{Rng, RngExt};

/// Number of further steps for which the distance at the end of a rollout is charged as the leaf value: steps
/// beyond the search depth count, but less than those within it.
const LEAF_VALUE_STEPS: f64 = 8.0;
/// Prior weight of the heuristic's action relative to any other. It decides where all actions have equal
/// value, as for an agent too weak to move its load.
const HEURISTIC_PRIOR_WEIGHT: f64 = 2.0;

/// The search model of an agent: its dynamics, its own action set, a passive model of the other agent, and
/// Equation 1 shaped by the distance to the subgoal.
#[derive(Debug)]
pub struct SearchModel<'a, D> {
    /// The physics.
    pub dynamics: &'a D,
    /// The agent's subgoal.
    pub objective: Objective<'a>,
    /// Objective of the other agent, followed while both hold the same object or touch.
    pub other_objective: Objective<'a>,
    /// Actions to search.
    pub actions: &'a [Action],
    /// Both agents' goals.
    pub goals: [Goal; AGENT_COUNT],
    /// Whether satisfied goals are rewarded. Not while the agent goes to verify one: the particles in which
    /// it holds already would make approaching appear worthless.
    pub rewards_goals: bool,
    /// The agent's attitude.
    pub attitude: Attitude,
    /// Discount factor per step.
    pub discount: f64,
    /// Probability that a rollout action comes from the heuristic, 0 to 1.
    pub heuristic_share: f64,
    /// Fidelity of the dynamics in the search.
    pub foresight: Foresight,
}

impl<'a, D> SearchModel<'a, D> {
    /// Objective of the other agent's own goal.
    #[must_use]
    pub fn other(
        physics: &'a PhysicsConfig,
        routes: &'a Routes,
        agent: AgentId,
        goals: [Goal; AGENT_COUNT],
    ) -> Objective<'a> {
        let subgoal = Subgoal::Achieve(Literal::from(goals[agent.other()]));
        Objective { physics, routes, agent: agent.other(), subgoal, backoff: None }
    }

    /// The other agent is passive (no force), except when both hold the same object or touch: then it follows
    /// the heuristic for its own goal. Otherwise a weak agent could not predict joint carrying, and two agents
    /// face to face would each predict that the other yields. A hinderer keeps the passive model on contact,
    /// since pushing the other away is what it attempts.
    fn other_action(&self, state: &State) -> Action {
        let (me, other) = (self.objective.agent, self.objective.agent.other());
        let together = state.held_object(me).is_some() && state.held_object(me) == state.held_object(other);
        let resists = self.attitude != Attitude::Hinder
            && state.contacts.touching(Entity::Agent(me), Entity::Agent(other));
        if together || resists {
            rollout_policy::action(&self.other_objective, state, None, &Action::ALL)
        } else {
            Action::NoForce
        }
    }

    /// The heuristic's action.
    fn heuristic_action(&self, search_state: &SearchState) -> Action {
        rollout_policy::action(&self.objective, &search_state.state, search_state.steering, self.actions)
    }

    fn reward(&self, search_state: &SearchState, action: Action) -> f64 {
        let state = &search_state.state;
        let agent = self.objective.agent;
        let satisfied = |goal| {
            let holds = self.rewards_goals && achieved(self.objective.physics, state, goal);
            f64::from(u8::from(holds))
        };
        let shaping = -f64::from(search_state.distance / ARENA_DIAGONAL);
        reward::social_reward(
            self.attitude,
            satisfied(self.goals[agent]),
            satisfied(self.other_goal()),
            action,
        ) + shaping
    }

    /// The goal of the social term of the reward: the other agent's own goal.
    const fn other_goal(&self) -> Goal {
        self.goals[self.objective.agent.other().index()]
    }

    /// Coarse observation: which entities are observed, and which observed agent holds what.
    fn observation_code(&self, state: &State) -> u16 {
        let agent = self.objective.agent;
        let observed = observed_set(self.objective.physics, state, agent);
        let mut code = u16::from(observed.bits());
        for who in AgentId::ALL {
            if observed.contains(Entity::Agent(who)) {
                let held = state.held_object(who).map_or(0, |object| u16::from(object.number()) + 1);
                code |= held << (4 + 2 * who.number());
            }
        }
        code
    }
}

/// A state of the search with the objective's distance and steering, which reward and rollout policy share.
#[derive(Clone, Copy, Debug)]
pub struct SearchState {
    state: State,
    distance: f32,
    steering: Option<Steering>,
}

impl SearchState {
    /// Evaluates the objective in a state.
    #[must_use]
    pub fn new(objective: &Objective<'_>, state: State) -> Self {
        let (distance, steering) = objective.evaluate(&state);
        Self { state, distance, steering }
    }

    /// The state itself.
    #[must_use]
    pub const fn state(&self) -> &State {
        &self.state
    }
}

impl<D: Dynamics> GenerativeModel for SearchModel<'_, D> {
    type State = SearchState;
    type Observation = u16;

    fn action_count(&self) -> usize {
        self.actions.len()
    }

    fn discount(&self) -> f64 {
        self.discount
    }

    fn step(&self, search_state: &mut SearchState, action: usize, random: &mut impl Rng) -> Transition<u16> {
        let Transition { reward, terminal, .. } = self.rollout_step(search_state, action, random);
        Transition { observation: self.observation_code(&search_state.state), reward, terminal }
    }

    fn rollout_step(
        &self,
        search_state: &mut SearchState,
        action: usize,
        _random: &mut impl Rng,
    ) -> Transition<()> {
        let state = &mut search_state.state;
        let agent = self.objective.agent;
        let action = self.actions[action];
        let mut actions = [self.other_action(state); AGENT_COUNT];
        actions[agent] = action;
        match self.foresight {
            Foresight::Coarse => self.dynamics.step_approximate(state, actions),
            Foresight::Exact => self.dynamics.step(state, actions),
        }
        (search_state.distance, search_state.steering) = self.objective.evaluate(state);
        Transition { observation: (), reward: self.reward(search_state, action), terminal: false }
    }

    fn rollout_action(&self, search_state: &SearchState, random: &mut impl Rng) -> usize {
        if random.random_bool(self.heuristic_share) {
            let heuristic_action = self.heuristic_action(search_state);
            if let Some(index) = self.actions.iter().position(|&action| action == heuristic_action) {
                return index;
            }
        }
        random.random_range(0..self.actions.len())
    }

    fn prior_weight(&self, search_state: &SearchState, action: usize) -> f64 {
        if self.actions[action] == self.heuristic_action(search_state) { HEURISTIC_PRIOR_WEIGHT } else { 1.0 }
    }

    fn is_deterministic(&self) -> bool {
        true
    }

    fn value_estimate(&self, search_state: &SearchState) -> f64 {
        self.reward(search_state, Action::NoForce) * LEAF_VALUE_STEPS
    }
}
