//! The agent's own model of the world, as POMCP searches it.

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

/// Steps for which the distance left at the end of an imagined future is taken to last: what a search of ten
/// steps cannot see still counts, but less than what it can.
const STEPS_BEYOND: f64 = 8.0;
/// How much more likely than any other the rule of thumb's action looks before it has been tried. Where all
/// actions come to the same, as for one too weak to move its load, it is what people expect to see.
const GUIDED_WEIGHT: f64 = 2.0;

/// What an agent imagines when it searches for an action: the physics it believes in, its own actions, the
/// other one coasting, and Equation 1 shaped by the distance to the subgoal.
#[derive(Debug)]
pub struct Imagination<'a, D> {
    /// The physics.
    pub dynamics: &'a D,
    /// The agent's subgoal.
    pub objective: Objective<'a>,
    /// What the other agent would do about its own goal if it is seen to hold the same object.
    pub other_objective: Objective<'a>,
    /// Actions to search.
    pub actions: &'a [Action],
    /// Both agents' goals.
    pub goals: [Goal; AGENT_COUNT],
    /// Whether goals that hold count. While an agent goes and looks whether one does, the mere hope must not
    /// make it shy of going near.
    pub goals_count: bool,
    /// The agent's attitude.
    pub attitude: Attitude,
    /// Discount a step.
    pub discount: f64,
    /// Share of informed rollout actions.
    pub guidance: f64,
    /// How exactly steps are worked out.
    pub foresight: Foresight,
}

impl<'a, D> Imagination<'a, D> {
    /// What the other would do about its goal.
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

    /// The other coasts, except when both hold the same object or the two touch: then it goes on pulling or
    /// pushing for its own goal. Without that a weak agent could not imagine what two can carry, and two who
    /// meet face to face would each believe that the other can be pushed away. Who hinders is to try just that.
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

    /// What the rule of thumb would do.
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

    /// The goal that the social part of the reward is about: the other's, as the other has it.
    const fn other_goal(&self) -> Goal {
        self.goals[self.objective.agent.other().index()]
    }

    /// What the agent notices, coarsely: who is observed, and who holds what of that.
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

/// A state as the search carries it along, with what the objective says of it: rewards and the rule of thumb ask
/// for the same.
#[derive(Clone, Copy, Debug)]
pub struct Imagined {
    state: State,
    distance: f32,
    course: Option<Course>,
}

impl Imagined {
    /// A state seen in the light of an objective.
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
