//! The generative model that POMCP searches: the agent's own model of the world.

use crate::{
    Foresight,
    course::Course,
    guidance,
    objective::{LONGEST, Objective},
};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Attitude, Dynamics, Entity, Goal, Literal, Physique, State, Subgoal, reward,
};
use phase_perception::observed_set;
use phase_planner::Routes;
use phase_pomcp::{GenerativeModel, Outcome};
use phase_predicates::achieved;
use rand::{Rng, RngExt};

/// Number of further steps for which the distance at the end of a rollout is charged as the leaf value:
/// steps beyond the search depth count, but less than those within it.
const STEPS_BEYOND: f64 = 8.0;
/// Prior weight of the heuristic's action relative to any other. It decides where all actions have equal
/// value, as for an agent too weak to move its load.
const GUIDED_WEIGHT: f64 = 2.0;

/// The search model of an agent: its dynamics, its own action set, a passive model of the other agent, and
/// Equation 1 shaped by the distance to the subgoal.
#[derive(Debug)]
pub struct Imagination<'a, D> {
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
    /// it holds already would make approaching look worthless.
    pub goals_count: bool,
    /// The agent's attitude.
    pub attitude: Attitude,
    /// Discount factor per step.
    pub discount: f64,
    /// Probability that a rollout action comes from the heuristic, 0 to 1.
    pub guidance: f64,
    /// Fidelity of the dynamics in the search.
    pub foresight: Foresight,
}

impl<'a, D> Imagination<'a, D> {
    /// Objective of the other agent's own goal.
    #[must_use]
    pub fn other(
        physique: &'a Physique,
        routes: &'a Routes,
        agent: AgentId,
        goals: [Goal; AGENT_COUNT],
    ) -> Objective<'a> {
        let subgoal = Subgoal::Achieve(Literal::from(goals[agent.other()]));
        Objective { physique, routes, agent: agent.other(), subgoal, retreat: None }
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
            guidance::action(&self.other_objective, state, None, &Action::ALL)
        } else {
            Action::NoForce
        }
    }

    /// The heuristic's action.
    fn guided(&self, imagined: &Imagined) -> Action {
        guidance::action(&self.objective, &imagined.state, imagined.course, self.actions)
    }

    fn reward(&self, imagined: &Imagined, action: Action) -> f64 {
        let state = &imagined.state;
        let agent = self.objective.agent;
        let satisfied = |goal| {
            let holds = self.goals_count && achieved(self.objective.physique, state, goal);
            f64::from(u8::from(holds))
        };
        let shaping = -f64::from(imagined.distance / LONGEST);
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
    fn notice(&self, state: &State) -> u16 {
        let agent = self.objective.agent;
        let observed = observed_set(self.objective.physique, state, agent);
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
pub struct Imagined {
    state: State,
    distance: f32,
    course: Option<Course>,
}

impl Imagined {
    /// Evaluates the objective in a state.
    #[must_use]
    pub fn new(objective: &Objective<'_>, state: State) -> Self {
        let (distance, course) = objective.look(&state);
        Self { state, distance, course }
    }

    /// The state itself.
    #[must_use]
    pub const fn state(&self) -> &State {
        &self.state
    }
}

impl<D: Dynamics> GenerativeModel for Imagination<'_, D> {
    type State = Imagined;
    type Observation = u16;

    fn action_count(&self) -> usize {
        self.actions.len()
    }

    fn discount(&self) -> f64 {
        self.discount
    }

    fn step(&self, imagined: &mut Imagined, action: usize, random: &mut impl Rng) -> Outcome<u16> {
        let Outcome { reward, terminal, .. } = self.rollout_step(imagined, action, random);
        Outcome { observation: self.notice(&imagined.state), reward, terminal }
    }

    fn rollout_step(&self, imagined: &mut Imagined, action: usize, _random: &mut impl Rng) -> Outcome<()> {
        let state = &mut imagined.state;
        let agent = self.objective.agent;
        let action = self.actions[action];
        let mut actions = [self.other_action(state); AGENT_COUNT];
        actions[agent] = action;
        match self.foresight {
            Foresight::Coarse => self.dynamics.imagine(state, actions),
            Foresight::Exact => self.dynamics.step(state, actions),
        }
        (imagined.distance, imagined.course) = self.objective.look(state);
        Outcome { observation: (), reward: self.reward(imagined, action), terminal: false }
    }

    fn rollout_action(&self, imagined: &Imagined, random: &mut impl Rng) -> usize {
        if random.random_bool(self.guidance) {
            let guided = self.guided(imagined);
            if let Some(index) = self.actions.iter().position(|&action| action == guided) {
                return index;
            }
        }
        random.random_range(0..self.actions.len())
    }

    fn prior_weight(&self, imagined: &Imagined, action: usize) -> f64 {
        if self.actions[action] == self.guided(imagined) { GUIDED_WEIGHT } else { 1.0 }
    }

    fn is_deterministic(&self) -> bool {
        true
    }

    fn value_estimate(&self, imagined: &Imagined) -> f64 {
        self.reward(imagined, Action::NoForce) * STEPS_BEYOND
    }
}
