//! One agent's plan from one physical state.

use crate::{
    Subgoal, aside, flight, hindrance,
    routes::{Route, Routes},
    search::{self, SymbolicPlan},
    situation::{Situation, Spot},
    task::{Node, Operator, Task},
};
use phase_model::{
    AGENT_COUNT, AgentId, Attitude, BodySet, Entity, Goal, Layout, ObjectId, Physique, Sign, State,
    layout::room_of,
};
use phase_predicates::{Literal, Place, Predicate, achieved};

/// What a helper's own travel counts for beside the helpee's: of two ways that are equally short it takes the
/// one that spares the other.
const HELPERS_EFFORT: f32 = 0.5;

/// A plan that costs this much contains something nearly impossible (u): see
/// [`crate::routes::IMPASSABLE_COST`] and the cost of a load too heavy.
const HOPELESS: f32 = 60.0;

/// What an agent means to do, from one possible world.
#[derive(Clone, PartialEq, Debug)]
pub struct Plan {
    /// The agent's own subgoals in order. Empty when there is nothing for it to do.
    pub subgoals: Vec<Subgoal>,
    /// Ĉ: distance that has to be travelled, by whoever travels in the plan, before the final goal state is
    /// reached (u).
    pub distance: f32,
}

impl Plan {
    /// The plan of an agent with nothing to do.
    pub const STAY: Self = Self { subgoals: Vec::new(), distance: 0.0 };

    /// The most immediate subgoal.
    #[must_use]
    pub fn first(&self) -> Subgoal {
        self.subgoals.first().copied().unwrap_or(Subgoal::Stay)
    }
}

/// The high-level planner of one agent: what it knows that does not change.
#[derive(Clone, Debug)]
pub struct Planner {
    physique: Physique,
    routes: Routes,
    agent: AgentId,
    goals: [Goal; AGENT_COUNT],
    attitude: Attitude,
}

impl Planner {
    /// A planner for one agent with both agents' goals, which are common knowledge, and its own attitude
    /// towards the other.
    #[must_use]
    pub fn new(
        physique: Physique,
        layout: Layout,
        agent: AgentId,
        goals: [Goal; AGENT_COUNT],
        attitude: Attitude,
    ) -> Self {
        Self { physique, routes: Routes::new(layout), agent, goals, attitude }
    }

    /// The ways between rooms.
    #[must_use]
    pub const fn routes(&self) -> &Routes {
        &self.routes
    }

    /// HP(gᵢ, gⱼ, αᵢⱼ, b) of Algorithm 1: the agent's best plan if the world is in this state, of which it
    /// observes these entities.
    #[must_use]
    pub fn plan(&self, state: &State, observed: BodySet) -> Plan {
        let situation = Situation::new(&self.physique, &self.routes, state);
        let own = self.goals[self.agent];
        let other = self.goals[self.agent.other()];
        match self.attitude {
            Attitude::Help => self.help(&situation, other, observed),
            Attitude::Hinder => hindrance::plan(&situation, self.agent, other),
            Attitude::Neutral if own.sign() == Sign::Negative => self.avoid(&situation, own),
            Attitude::Neutral => self.pursue(&situation, own, other, observed),
        }
    }

    /// A neutral agent reaches for its own goal by its own means. Only when the other wants the very same, and
    /// it cannot do it alone, is the other counted on.
    fn pursue(&self, situation: &Situation<'_>, own: Goal, other: Goal, observed: BodySet) -> Plan {
        if let Some(plan) = self.finish(situation, own, observed) {
            return plan;
        }
        let task = Task {
            situation,
            goal: own,
            actors: only(self.agent),
            effort: [1.0; AGENT_COUNT],
            allied: own == other,
            narrowed: None,
        };
        let alone = search::solve(&task, Node::start(situation));
        match alone {
            Some(plan) if own != other || plan.cost < HOPELESS => express(&task, &plan, self.agent),
            _ if own == other => self.cooperate(situation, own, 1.0, observed),
            _ => Plan::STAY,
        }
    }

    /// The own part of the cheapest way in which both together reach a goal; the own travel counts for
    /// `own_effort` beside the other's. Who has no part in it gets out of the other's way.
    fn cooperate(&self, situation: &Situation<'_>, goal: Goal, own_effort: f32, observed: BodySet) -> Plan {
        let mut effort = [1.0; AGENT_COUNT];
        effort[self.agent] = own_effort;
        let actors = [true; AGENT_COUNT];
        let task = Task { situation, goal, actors, effort, allied: true, narrowed: None };
        let plan = search::solve(&task, Node::start(situation))
            .map_or(Plan::STAY, |plan| express(&task, &plan, self.agent));
        // Not being needed is something to be seen.
        let unseen = [goal.subject(), Entity::Agent(self.agent.other())];
        match unseen.into_iter().find(|&entity| !observed.contains(entity)) {
            Some(entity) if plan.subgoals.is_empty() => {
                // Where one cannot go and look, the hope that all is well elsewhere must cost no less than that.
                let visit = visit(situation, self.agent, entity);
                Plan { distance: plan.distance.max(visit.distance), ..visit }
            }
            None if plan.subgoals.is_empty() => {
                let aside = aside::subgoal(situation, self.agent, goal);
                Plan { subgoals: aside.into_iter().collect(), ..plan }
            }
            _ => plan,
        }
    }

    /// A helper looks for the cheapest way in which both together reach the other's goal, and does its own
    /// part of it; if the other does best alone, that part is nothing.
    fn help(&self, situation: &Situation<'_>, goal: Goal, observed: BodySet) -> Plan {
        if goal.sign() == Sign::Negative {
            return self.help_to_avoid(situation, goal);
        }
        if let Some(plan) = self.finish(situation, goal, observed) {
            return plan;
        }
        self.cooperate(situation, goal, HELPERS_EFFORT, observed)
    }

    /// Who wants to be left alone is helped by keeping away; other negated goals by undoing them.
    fn help_to_avoid(&self, situation: &Situation<'_>, goal: Goal) -> Plan {
        match goal {
            Goal::Touch { .. } => flight::plan(situation, self.agent),
            _ => hindrance::plan(situation, self.agent, goal.negated()),
        }
    }

    /// A negated goal of one's own: flight from the other, or keeping something off a landmark.
    fn avoid(&self, situation: &Situation<'_>, goal: Goal) -> Plan {
        match goal {
            Goal::Touch { .. } => flight::plan(situation, self.agent),
            _ => hindrance::plan(situation, self.agent, goal.negated()),
        }
    }

    /// What to do once the goal holds: let go of whatever is in hand, else nothing. An agent that believes an
    /// object to be where it should be without observing it goes and looks. `None` while the goal does not hold.
    fn finish(&self, situation: &Situation<'_>, goal: Goal, observed: BodySet) -> Option<Plan> {
        if !achieved(situation.physique, situation.state, goal) {
            return None;
        }
        match goal.subject() {
            object @ Entity::Object(_) if !observed.contains(object) => {
                Some(visit(situation, self.agent, object))
            }
            _ => Some(let_go(situation, self.agent)),
        }
    }
}

/// The plan of going to an entity to see it.
fn visit(situation: &Situation<'_>, agent: AgentId, entity: Entity) -> Plan {
    let me = Entity::Agent(agent);
    let (from, to) = (situation.state.position(me), situation.state.position(entity));
    let mut subgoals = Vec::new();
    let width = situation.width(agent, None);
    let route = situation.routes.best(from, to, width, situation.routes.gaps());
    if let Some(route) = &route {
        rooms(route, from, to, me, &mut subgoals);
    }
    subgoals.push(is(Predicate::Close(me, Place::Entity(entity))));
    // Near and yet unobserved, it is behind one's back: reaching for it means turning to it.
    subgoals.push(is(Predicate::Touch(agent, entity)));
    skip_done(situation, &mut subgoals);
    Plan { subgoals, distance: route.map_or(0.0, |route| route.cost()) }
}

/// Drops the leading subgoals that hold already: what is left begins with something to bring about.
pub(crate) fn skip_done(situation: &Situation<'_>, subgoals: &mut Vec<Subgoal>) {
    let done = subgoals
        .iter()
        .take_while(|subgoal| {
            matches!(subgoal, Subgoal::Achieve(literal)
                if literal.is_true(situation.physique, situation.state))
        })
        .count();
    subgoals.drain(..done);
}

/// The plan of letting go of whatever is in hand and then staying.
#[must_use]
pub(crate) fn let_go(situation: &Situation<'_>, agent: AgentId) -> Plan {
    situation.state.grips[agent].map_or(Plan::STAY, |grip| Plan {
        subgoals: vec![not(Predicate::Attach(agent, grip.object))],
        distance: 0.0,
    })
}

/// One agent's own part of a symbolic plan in the words of the subgoal space, and how far all have to travel.
#[must_use]
pub(crate) fn express(task: &Task<'_>, plan: &SymbolicPlan, agent: AgentId) -> Plan {
    let mut subgoals = Vec::with_capacity(8);
    let mut distance = 0.0;
    for (node, operator) in &plan.steps {
        distance += travel(task, node, *operator);
        match *operator {
            Operator::Approach { agent: who, object } if who == agent => {
                let spot = node.objects[object];
                go(task, node, agent, None, spot, &mut subgoals);
                let target = Place::Entity(Entity::Object(object));
                subgoals.push(is(Predicate::Close(Entity::Agent(agent), target)));
            }
            Operator::Meet { agent: who } if who == agent => {
                go(task, node, agent, None, node.agents[agent.other()], &mut subgoals);
                subgoals.push(is(Predicate::Touch(agent, Entity::Agent(agent.other()))));
            }
            Operator::Go { agent: who, landmark } if who == agent => {
                go(task, node, agent, None, Spot::Landmark(landmark), &mut subgoals);
                subgoals.push(is(Predicate::On(Entity::Agent(agent), landmark)));
            }
            Operator::Grab { agent: who, object } if who == agent => {
                subgoals.push(is(Predicate::Attach(agent, object)));
            }
            Operator::Carry { object, landmark, .. } if node.holds[agent] == Some(object) => {
                go(task, node, agent, Some(object), Spot::Landmark(landmark), &mut subgoals);
                subgoals.push(is(Predicate::On(Entity::Object(object), landmark)));
            }
            Operator::Pass { agent: who, object, slot, room } if who == agent => {
                let near = Routes::beyond(slot, room);
                go(task, node, agent, Some(object), Spot::Inside { slot, room: near }, &mut subgoals);
                let place = Place::Landmark(room.landmark());
                subgoals.push(is(Predicate::Close(Entity::Object(object), place)));
                subgoals.push(not(Predicate::Attach(agent, object)));
            }
            Operator::Release { agent: who, object } if who == agent => {
                subgoals.push(not(Predicate::Attach(agent, object)));
            }
            _ => {}
        }
    }
    skip_done(task.situation, &mut subgoals);
    Plan { subgoals, distance }
}

/// Distance travelled in one operator, whoever travels (u).
fn travel(task: &Task<'_>, node: &Node, operator: Operator) -> f32 {
    match operator {
        Operator::Approach { agent, object } => task.distance(node, agent, None, node.objects[object]),
        Operator::Meet { agent } => task.distance(node, agent, None, node.agents[agent.other()]),
        Operator::Go { agent, landmark } => task.distance(node, agent, None, Spot::Landmark(landmark)),
        Operator::Carry { agent, object, landmark } => {
            task.distance(node, agent, Some(object), Spot::Landmark(landmark))
        }
        Operator::Pass { agent, object, slot, room } => {
            let near = Routes::beyond(slot, room);
            task.distance(node, agent, Some(object), Spot::Inside { slot, room: near })
        }
        Operator::Grab { .. } | Operator::Release { .. } => 0.0,
    }
}

/// The rooms on the way to a spot, as Close(·, landmark) subgoals for the agent or for what it carries. Rooms
/// that the straight way passes through anyway are not worth a subgoal.
fn go(
    task: &Task<'_>,
    node: &Node,
    agent: AgentId,
    held: Option<ObjectId>,
    spot: Spot,
    subgoals: &mut Vec<Subgoal>,
) {
    let situation = task.situation;
    let from_spot = held.map_or(node.agents[agent], |object| node.objects[object]);
    let (from, to) = (situation.position(from_spot), situation.position(spot));
    let mover = held.map_or(Entity::Agent(agent), Entity::Object);
    let width = situation.width(agent, held);
    let gaps = task.gaps(node, agent, held);
    if let Some(route) = situation.routes.best(from, to, width, &gaps) {
        rooms(&route, from, to, mover, subgoals);
    }
}

/// Close(mover, landmark) for each room of a route but the first.
pub(crate) fn rooms(
    route: &Route,
    from: phase_model::Vec2,
    to: phase_model::Vec2,
    mover: Entity,
    subgoals: &mut Vec<Subgoal>,
) {
    const STRAIGHT: f32 = 1.01;
    if route.length <= from.distance(to) * STRAIGHT {
        return;
    }
    let mut room = room_of(from);
    for &(slot, _) in route.doors() {
        room = Routes::beyond(slot, room);
        subgoals.push(is(Predicate::Close(mover, Place::Landmark(room.landmark()))));
    }
}

/// The subgoal of making a predicate true.
#[must_use]
pub(crate) const fn is(predicate: Predicate) -> Subgoal {
    Subgoal::Achieve(Literal::is(predicate))
}

/// The subgoal of making a predicate false.
#[must_use]
pub(crate) const fn not(predicate: Predicate) -> Subgoal {
    Subgoal::Achieve(Literal::not(predicate))
}

/// The set of just one agent.
#[must_use]
pub(crate) fn only(agent: AgentId) -> [bool; AGENT_COUNT] {
    AgentId::ALL.map(|who| who == agent)
}
