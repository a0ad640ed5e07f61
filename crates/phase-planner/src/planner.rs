//! One agent's planner: which kind of plan its goal and attitude require.

use crate::{
    interference,
    parameters::PlannerParameters,
    plan::{Plan, inspect, is, not, only, release, rooms},
    problem::{Location, PlanningProblem},
    search,
    symbolic::Node,
    task::{Effort, PlanningTask},
    to_subgoals::to_subgoals,
    yielding,
};
use phase_model::{
    AGENT_COUNT, AgentId, Attitude, BodySet, Entity, Goal, Layout, ObjectId, PhysicsConfig, Predicate, Sign,
    State,
};
use phase_navigation::Map;
use phase_predicates::achieved;

/// The high-level planner of one agent, with everything that does not change during an event.
///
/// [`plan`](Self::plan) is a function of the state alone: a planner keeps nothing between calls, uses no
/// chance, and may be shared by threads. A call solves a few small A\* problems. Attitudes decide which: an
/// own goal, the other's goal together with it, or a rise of the other's cost.
///
/// An object is too heavy for the agent that wants it on a landmark. Alone it tries in vain; a strong helper
/// brings it there.
///
/// ```
/// use phase_model::{
///     AgentBody, AgentId, Attitude, Body, Goal, LandmarkId, Layout, ObjectId, PhysicsConfig, Sign, State,
///     Vec2,
/// };
/// use phase_planner::Planner;
///
/// # fn main() -> Result<(), phase_model::LayoutError> {
/// let layout = Layout::new(0, None)?; // without inner walls
/// let agents = [AgentBody { radius: 0.8, max_force: 150.0 }, AgentBody { radius: 0.8, max_force: 450.0 }];
/// let physics = PhysicsConfig {
///     walls: layout.walls(),
///     agents,
///     object_radii: [1.0, 0.0], // u
///     object_count: 1,
/// };
/// let places = [Vec2::new(9.0, 16.0), Vec2::new(13.0, 16.0), Vec2::new(14.0, 19.0), Vec2::ZERO];
/// let state = State::new(places.map(|place| Body::at_rest(place, 0.0)));
/// let (object, landmark) = (ObjectId::ZERO, LandmarkId::BOTTOM_RIGHT);
/// let goal = Goal::ObjectOnLandmark { object, landmark, sign: Sign::Positive };
/// let plan = |agent, attitude, goals| {
///     let planner = Planner::new(physics.clone(), layout, agent, goals, attitude);
///     planner.plan(&state, physics.entities().collect()) // it sees everything
/// };
/// // A goal of its own has no part in the plans of an agent that helps or hinders.
/// let own = Goal::AgentOnLandmark { agent: AgentId::ONE, landmark, sign: Sign::Positive };
///
/// let alone = plan(AgentId::ZERO, Attitude::Neutral, [goal, own]);
/// assert_eq!(alone.subgoals[1].to_string(), "Attach(agent 0, object 0)");
/// assert!(!alone.is_feasible);
///
/// let helper = plan(AgentId::ONE, Attitude::Help, [goal, own]);
/// let words: Vec<String> = helper.subgoals.iter().map(ToString::to_string).collect();
/// assert_eq!(words[0], "Attach(agent 1, object 0)");
/// assert_eq!(words[1], "On(object 0, landmark 2)");
/// assert!(helper.is_feasible);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Planner {
    physics: PhysicsConfig,
    map: Map,
    agent: AgentId,
    goals: [Goal; AGENT_COUNT],
    attitude: Attitude,
    parameters: PlannerParameters,
}

impl Planner {
    /// A planner for one agent with both agents' goals, which are common knowledge, and its own attitude
    /// towards the other; with the default parameters.
    #[must_use]
    pub fn new(
        physics: PhysicsConfig,
        layout: Layout,
        agent: AgentId,
        goals: [Goal; AGENT_COUNT],
        attitude: Attitude,
    ) -> Self {
        Self::with_parameters(physics, layout, agent, goals, attitude, PlannerParameters::default())
    }

    /// A planner with other parameters, which [`PlannerParameters::validate`] checks.
    #[must_use]
    pub fn with_parameters(
        physics: PhysicsConfig,
        layout: Layout,
        agent: AgentId,
        goals: [Goal; AGENT_COUNT],
        attitude: Attitude,
        parameters: PlannerParameters,
    ) -> Self {
        Self { physics, map: Map::new(layout), agent, goals, attitude, parameters }
    }

    /// HP(gᵢ, gⱼ, αᵢⱼ, b) of Algorithm 1: the agent's best plan if the world is in this state, of which it
    /// observes these entities.
    ///
    /// The plan uses the positions of all entities, observed or not. An agent that would rest because the
    /// other does what is needed, or because an object is where it should be, first goes to observe that.
    ///
    /// The plan is [`Plan::NONE`] if the state is not finite ([`State::is_finite`]) or a goal is about an
    /// object that does not exist.
    #[must_use]
    pub fn plan(&self, state: &State, observed: BodySet) -> Plan {
        self.plan_ceding(state, observed, None)
    }

    /// The agent's best plan as by [`plan`](Self::plan) while it leaves an object to the other: it lets go of
    /// it and lays no hands on it. An agent that wants the object goes where it is and waits; one that
    /// prevents something does so by other means. Agents with the same goal cede nothing to each other.
    #[must_use]
    pub fn plan_ceding(&self, state: &State, observed: BodySet, ceded: Option<ObjectId>) -> Plan {
        let exists = |goal: &Goal| self.physics.entities().any(|entity| entity == goal.subject());
        if !state.is_finite(&self.physics) || !self.goals.iter().all(exists) {
            return Plan::NONE;
        }
        let problem = PlanningProblem::new(&self.physics, &self.map, state, self.parameters);
        let own = self.goals[self.agent];
        let other = self.goals[self.agent.other()];
        // A goal is to become true or not to become true, by its sign and, for the other's goal, the
        // attitude.
        let (goal, is_wanted) = match self.attitude {
            Attitude::Neutral => (own, own.sign() == Sign::Positive),
            Attitude::Help => (other, other.sign() == Sign::Positive),
            Attitude::Hinder => (other, other.sign() == Sign::Negative),
        };
        let condition = if goal.sign() == Sign::Positive { goal } else { goal.negated() };
        let ceded = ceded.filter(|_| own != other);
        if let Some(object) = ceded
            && state.holds(self.agent, object)
        {
            return release(&problem, self.agent);
        }
        match self.attitude {
            _ if !is_wanted => self.prevent(&problem, condition, observed, ceded),
            _ if ceded.is_some_and(|object| goal.subject() == Entity::Object(object)) => {
                self.wait_for(&problem, goal.subject(), observed)
            }
            Attitude::Help => self.help(&problem, other, observed),
            Attitude::Neutral if own != other.negated() => self.pursue(&problem, own, other, observed),
            _ => self.contend(&problem, condition),
        }
    }

    /// Raises the other's cost of a condition. An agent that would stay, since the other cannot make the
    /// condition true, has to observe that.
    fn prevent(
        &self,
        problem: &PlanningProblem<'_>,
        condition: Goal,
        observed: BodySet,
        ceded: Option<ObjectId>,
    ) -> Plan {
        let plan = interference::plan(problem, self.agent, condition, ceded);
        let unseen = [condition.subject(), Entity::Agent(self.agent.other())];
        let unseen = unseen.into_iter().find(|&entity| !observed.contains(entity));
        match unseen {
            Some(entity) if plan.subgoals.is_empty() && self.attitude == Attitude::Hinder => {
                inspect(problem, self.agent, entity)
            }
            _ => plan,
        }
    }

    /// Goes where an object is that the other has, and stays there.
    fn wait_for(&self, problem: &PlanningProblem<'_>, object: Entity, observed: BodySet) -> Plan {
        let mut plan = inspect(problem, self.agent, object);
        if observed.contains(object) {
            plan.subgoals.retain(|&subgoal| subgoal != is(Predicate::Touch(self.agent, object)));
        }
        plan
    }

    /// A neutral agent plans with its own actions. It relies on the other only if both have the same goal and
    /// it cannot achieve it alone. An agent that would have no part in their plan tries alone, and so shows
    /// what it wants: it waits where it cannot go on, lends a hand where it can, and stays out of the way of
    /// the other that has the object.
    fn pursue(&self, problem: &PlanningProblem<'_>, own: Goal, other: Goal, observed: BodySet) -> Plan {
        if let Some(plan) = self.finish(problem, own, observed) {
            return plan;
        }
        let task = PlanningTask {
            problem,
            goal: own,
            actors: only(self.agent),
            efforts: [Effort::OWN; AGENT_COUNT],
            cooperative: own == other,
            narrowed: None,
        };
        let alone = search::solve(&task, Node::start(problem));
        match alone {
            Some(plan) if own != other || plan.cost < self.parameters.impassable => {
                to_subgoals(&task, &plan, self.agent)
            }
            Some(plan) if matches!(own.subject(), Entity::Object(_)) => {
                let joint = self.joint_plan(problem, own, self.agent);
                if !joint.subgoals.is_empty() {
                    return joint;
                }
                let yielding =
                    self.is_helped(problem, own).then(|| yielding::subgoal(problem, self.agent, own));
                let trying = || to_subgoals(&task, &plan, self.agent).subgoals;
                let subgoals = yielding.flatten().map_or_else(trying, |subgoal| vec![subgoal]);
                Plan { subgoals, ..joint }
            }
            _ if own == other => self.cooperate(problem, own, self.agent, observed),
            _ => Plan::NONE,
        }
    }

    /// Whether the other has the object of a goal in hand.
    fn is_helped(&self, problem: &PlanningProblem<'_>, goal: Goal) -> bool {
        matches!(goal.subject(), Entity::Object(object) if problem.state.holds(self.agent.other(), object))
    }

    /// The agent's part of the cheapest joint plan for a goal of `owner`, whom the other agent helps. Of two
    /// agents with the same goal each considers itself the owner.
    fn joint_plan(&self, problem: &PlanningProblem<'_>, goal: Goal, owner: AgentId) -> Plan {
        let mut efforts = [Effort::OWN; AGENT_COUNT];
        efforts[owner.other()] = Effort::helper(self.parameters.effort);
        let actors = [true; AGENT_COUNT];
        let task = PlanningTask { problem, goal, actors, efforts, cooperative: true, narrowed: None };
        search::solve(&task, Node::start(problem))
            .map_or(Plan::NONE, |plan| to_subgoals(&task, &plan, self.agent))
    }

    /// The agent's [part](Self::joint_plan) of a joint plan. An agent without one yields.
    fn cooperate(
        &self,
        problem: &PlanningProblem<'_>,
        goal: Goal,
        owner: AgentId,
        observed: BodySet,
    ) -> Plan {
        let plan = self.joint_plan(problem, goal, owner);
        // An agent has to observe that it is not needed.
        let unseen = [goal.subject(), Entity::Agent(self.agent.other())];
        match unseen.into_iter().find(|&entity| !observed.contains(entity)) {
            Some(entity) if plan.subgoals.is_empty() => {
                // If the entity cannot be reached, the optimistic particles must not be cheaper than the path
                // there.
                let inspect = inspect(problem, self.agent, entity);
                Plan { distance: plan.distance.max(inspect.distance), ..inspect }
            }
            None if plan.subgoals.is_empty() => {
                let yielding = yielding::subgoal(problem, self.agent, goal);
                Plan { subgoals: yielding.into_iter().collect(), ..plan }
            }
            _ => plan,
        }
    }

    /// A helper searches for the cheapest plan in which both together achieve the other's goal, and does its
    /// own part of it; if the other does best alone, that part is empty.
    fn help(&self, problem: &PlanningProblem<'_>, goal: Goal, observed: BodySet) -> Plan {
        if let Some(plan) = self.finish(problem, goal, observed) {
            return plan;
        }
        self.cooperate(problem, goal, self.agent.other(), observed)
    }

    /// Makes a condition true that the other wants to be false, and maintains it, since the other would undo
    /// it.
    fn contend(&self, problem: &PlanningProblem<'_>, condition: Goal) -> Plan {
        let me = Entity::Agent(self.agent);
        let actors = only(self.agent);
        let efforts = [Effort::OWN; AGENT_COUNT];
        let task =
            PlanningTask { problem, goal: condition, actors, efforts, cooperative: false, narrowed: None };
        let last = match (condition, condition.landmark()) {
            (_, Some(landmark)) => is(Predicate::On(condition.subject(), landmark)),
            _ => is(Predicate::Touch(self.agent, Entity::Agent(self.agent.other()))),
        };
        let mut plan = search::solve(&task, Node::start(problem)).map_or_else(
            || {
                // No operator moves the other; it has to be pushed.
                let from = problem.position(Location::Current(me));
                let to = problem.position(Location::Current(condition.subject()));
                let width = problem.width(self.agent, None);
                let mut plan = Plan { is_feasible: false, ..release(problem, self.agent) };
                let gaps = problem.gaps(self.agent, BodySet::OBJECTS);
                if let Some(route) = problem.route(from, to, width, gaps) {
                    plan.distance = route.cost;
                    plan.is_feasible = route.impassable == 0;
                    rooms(&route, from, to, me, &mut plan.subgoals);
                }
                plan
            },
            |plan| to_subgoals(&task, &plan, self.agent),
        );
        if let Entity::Object(object) = condition.subject() {
            plan.subgoals.retain(|&subgoal| subgoal != not(Predicate::Attach(self.agent, object)));
        }
        if plan.subgoals.last() != Some(&last) {
            plan.subgoals.push(last);
        }
        plan
    }

    /// The plan once the goal holds: release whatever is held, otherwise nothing. An agent that believes an
    /// object to be in its goal position without observing it goes to verify that. `None` while the goal does
    /// not hold.
    fn finish(&self, problem: &PlanningProblem<'_>, goal: Goal, observed: BodySet) -> Option<Plan> {
        if !achieved(problem.physics, problem.state, goal) {
            return None;
        }
        match goal.subject() {
            object @ Entity::Object(_) if !observed.contains(object) => {
                Some(inspect(problem, self.agent, object))
            }
            _ => Some(release(problem, self.agent)),
        }
    }
}
