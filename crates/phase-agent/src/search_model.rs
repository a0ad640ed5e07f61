//! The generative model that POMCP searches: the agent's own model of the world.

use crate::{
    Foresight,
    habits::{self, Context},
    objective::Objective,
    pretext::{Guess, Scrutiny},
    rollout_policy,
};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Attitude, Dynamics, Entity, Goal, PhysicsConfig, State, arena, reward,
};
use phase_perception::observed_set;
use phase_pomcp::{GenerativeModel, Transition};
use phase_predicates::achieved;
use rand::{Rng, RngExt};

/// The search model of an agent: its dynamics, its own action set, a model of the other agent, and Equation 1
/// less the distance to go of the subgoal.
#[derive(Debug)]
pub struct SearchModel<'a, D> {
    /// The physics.
    pub dynamics: &'a D,
    /// The agent's subgoal.
    pub objective: Objective<'a>,
    /// Bodies and walls.
    pub physics: &'a PhysicsConfig,
    /// Objective of the other agent's own goal.
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
    /// The other's view of the agent's actions, if it costs the agent something.
    pub scrutiny: Option<Scrutiny<'a>>,
    /// Prior weights of the root's actions, in place of habits; empty for none.
    pub root_prior: Vec<f64>,
}

impl<D> SearchModel<'_, D> {
    /// Another agent that was in motion at the root pursues its own goal by the heuristic in a share of the
    /// steps, evenly spaced, and coasts in the others; one at rest stays at rest. While the two touch, or
    /// hold the same object, it follows the heuristic in every step. A model that only coasts believes that
    /// every push will do, and two who push each other would go on for ever. Nothing is drawn, so that the
    /// tree's steps can be cached.
    fn other_action(&self, search_state: &SearchState) -> Action {
        let p = self.objective.parameters().other_initiative;
        let count = |steps: u16| libm::floor(f64::from(steps) * p);
        let acts = search_state.other_moves && count(search_state.steps + 1) > count(search_state.steps);
        if acts || self.in_contact(&search_state.state) {
            rollout_policy::action(&self.other_objective, &search_state.state)
        } else {
            Action::NoForce
        }
    }

    /// Whether the two agents touch, or hold the same object.
    fn in_contact(&self, state: &State) -> bool {
        let [first, second] = AgentId::ALL;
        let held = state.held_object(first);
        state.contacts.touching(Entity::Agent(first), Entity::Agent(second))
            || held.is_some() && held == state.held_object(second)
    }

    /// The actions of both agents where this one does something.
    fn joint_action(&self, search_state: &SearchState, action: Action) -> [Action; AGENT_COUNT] {
        let mut actions = [self.other_action(search_state); AGENT_COUNT];
        actions[self.objective.agent()] = action;
        actions
    }

    /// Evaluates a state that an action has led to.
    fn conclude(&self, search_state: &mut SearchState, action: Action) -> Transition<()> {
        search_state.distance = self.objective.distance(&search_state.state);
        search_state.last_action = Some(action);
        search_state.steps += 1;
        Transition { observation: (), reward: self.reward(search_state, action), terminal: false }
    }

    fn reward(&self, search_state: &SearchState, action: Action) -> f64 {
        let state = &search_state.state;
        let agent = self.objective.agent();
        let satisfied = |goal| {
            let holds = self.rewards_goals && achieved(self.physics, state, goal);
            f64::from(u8::from(holds))
        };
        let shaping = -f64::from(search_state.distance / arena::DIAGONAL);
        let suspicion = self.scrutiny.as_ref().map_or(0.0, |scrutiny| scrutiny.cost(&search_state.guess));
        reward::social_reward(
            self.attitude,
            satisfied(self.goals[agent]),
            satisfied(self.goals[agent.other()]),
            action,
        ) + shaping
            - suspicion
    }

    /// Whether the other perceives the agent.
    fn is_seen(&self, state: &State) -> bool {
        let agent = self.objective.agent();
        observed_set(self.physics, state, agent.other()).contains(Entity::Agent(agent))
    }

    /// Coarse observation: which entities are observed, and which observed agent holds what.
    fn observation_code(&self, state: &State) -> u16 {
        let observed = observed_set(self.physics, state, self.objective.agent());
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

/// A state of the search with the distance to go, which reward, value and priors share.
#[derive(Clone, Copy, Debug)]
pub struct SearchState {
    state: State,
    distance: f32,
    last_action: Option<Action>,
    /// Steps from the root.
    steps: u16,
    /// Whether the other agent was in motion at the root.
    other_moves: bool,
    /// The other's guess at the agent's intent.
    guess: Guess,
}

impl SearchState {
    /// Evaluates the objective in a state that an action of the agent has led to.
    #[must_use]
    pub fn new(objective: &Objective<'_>, state: State, last_action: Option<Action>) -> Self {
        let other = state.body(Entity::Agent(objective.agent().other()));
        let other_moves = other.velocity.length() > objective.parameters().moving_speed;
        let distance = objective.distance(&state);
        Self { state, distance, last_action, steps: 0, other_moves, guess: Guess::default() }
    }

    /// This state as the other sees the agent in it.
    #[must_use]
    pub fn under(mut self, scrutiny: &Scrutiny<'_>) -> Self {
        self.guess = scrutiny.guess();
        self
    }

    /// Φ (u).
    pub(crate) const fn distance(&self) -> f32 {
        self.distance
    }

    /// The agent's last action.
    pub(crate) const fn last_action(&self) -> Option<Action> {
        self.last_action
    }

    /// The circumstances that priors of actions depend on.
    pub(crate) const fn context(&self, heuristic: Action) -> Context {
        Context { heuristic, last: self.last_action, distance: self.distance }
    }

    /// The state itself.
    #[must_use]
    pub const fn state(&self) -> &State {
        &self.state
    }
}

impl<D: Dynamics> SearchModel<'_, D> {
    /// Imagines a step in which the agent takes an action.
    pub(crate) fn imagine(&self, search_state: &mut SearchState, action: Action) -> Transition<()> {
        let actions = self.joint_action(search_state, action);
        // The other learns from a step that it perceives from beginning to end.
        let evidence = self.scrutiny.as_ref().map(|scrutiny| {
            let SearchState { state, last_action, .. } = search_state;
            let likelihoods = || scrutiny.likelihoods(&self.objective, state, *last_action, action);
            self.is_seen(state).then(likelihoods)
        });
        let state = &mut search_state.state;
        match self.objective.parameters().foresight {
            Foresight::Coarse | Foresight::Points => self.dynamics.step_approximate(state, actions),
            Foresight::Exact => self.dynamics.step(state, actions),
        }
        if let (Some(scrutiny), Some(evidence)) = (&self.scrutiny, evidence) {
            let seen = evidence.filter(|_| self.is_seen(&search_state.state));
            scrutiny.learn(&mut search_state.guess, seen);
        }
        self.conclude(search_state, action)
    }
}

impl<D: Dynamics> GenerativeModel for SearchModel<'_, D> {
    type State = SearchState;
    type Observation = u16;

    fn action_count(&self) -> usize {
        self.actions.len()
    }

    fn discount(&self) -> f64 {
        self.objective.parameters().discount
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
        self.imagine(search_state, self.actions[action])
    }

    fn rollout_action(&self, search_state: &SearchState, random: &mut impl Rng) -> usize {
        if random.random_bool(self.objective.parameters().heuristic_share) {
            let heuristic = rollout_policy::action(&self.objective, &search_state.state);
            if let Some(index) = self.actions.iter().position(|&action| action == heuristic) {
                return index;
            }
        }
        random.random_range(0..self.actions.len())
    }

    fn prior_weights(&self, search_state: &SearchState, weights: &mut Vec<f64>) {
        if search_state.steps == 0 && !self.root_prior.is_empty() {
            weights.extend_from_slice(&self.root_prior);
            return;
        }
        let context = search_state.context(rollout_policy::action(&self.objective, &search_state.state));
        let weight = |&action: &Action| habits::weight(action, &self.objective, &search_state.state, context);
        weights.extend(self.actions.iter().map(weight));
    }

    fn is_deterministic(&self) -> bool {
        true
    }

    fn value_estimate(&self, search_state: &SearchState) -> f64 {
        self.reward(search_state, Action::NoForce) * self.objective.parameters().horizon_steps
    }
}
