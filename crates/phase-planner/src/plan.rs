//! An agent's plan, and the building blocks of plans of all kinds.

use crate::{
    accuracy::STRAIGHT,
    problem::{Location, PlanningProblem},
};
use phase_model::{
    AGENT_COUNT, AgentId, Entity, Literal, Predicate, PredicateTarget, Subgoal, layout::room_of,
};
use phase_navigation::Route;
use phase_predicates::is_true;

/// An agent's plan from one possible state: its own subgoals in order, and the distance left for all agents.
///
/// [`value::candidates`](crate::value::candidates) compares the plans of all particles of a belief by both.
/// An empty plan means that there is nothing to do; [`first`](Self::first) is then [`Subgoal::Stay`].
#[derive(Clone, PartialEq, Debug)]
pub struct Plan {
    /// The agent's own subgoals in order. Empty when there is nothing for it to do.
    pub subgoals: Vec<Subgoal>,
    /// Ĉ: distance that has to be travelled, by all agents in the plan, before the final goal state is
    /// reached (u). A door on the way that is too narrow adds its price,
    /// [`impassable`](crate::PlannerParameters::impassable).
    pub distance: f32,
    /// Whether the plan can be carried out: it needs no door that is too narrow and no load that is too
    /// heavy. An agent attempts the best plan even if it cannot.
    pub is_feasible: bool,
}

impl Plan {
    /// The plan of an agent with nothing to do.
    pub const STAY: Self = Self { subgoals: Vec::new(), distance: 0.0, is_feasible: true };

    /// The plan of an agent that finds nothing to try.
    pub const NONE: Self = Self { subgoals: Vec::new(), distance: 0.0, is_feasible: false };

    /// The most immediate subgoal.
    #[must_use]
    pub fn first(&self) -> Subgoal {
        self.subgoals.first().copied().unwrap_or(Subgoal::Stay)
    }
}

/// The plan of going to an entity in order to see it.
pub(crate) fn inspect(problem: &PlanningProblem<'_>, agent: AgentId, entity: Entity) -> Plan {
    let me = Entity::Agent(agent);
    let from = problem.position(Location::Current(me));
    let to = problem.position(Location::Current(entity));
    let mut subgoals = Vec::new();
    let width = problem.width(agent, None);
    let route = problem.route(from, to, width, problem.map.gaps());
    if let Some(route) = &route {
        rooms(route, from, to, me, &mut subgoals);
    }
    subgoals.push(is(Predicate::Close(me, PredicateTarget::Entity(entity))));
    // Close and yet unobserved means behind the agent's back: approaching it means turning around.
    subgoals.push(is(Predicate::Touch(agent, entity)));
    drop_satisfied(problem, &mut subgoals);
    Plan {
        subgoals,
        distance: route.map_or(0.0, |route| route.cost),
        is_feasible: route.is_some_and(|route| route.impassable == 0),
    }
}

/// Drops the leading subgoals that are satisfied already.
pub(crate) fn drop_satisfied(problem: &PlanningProblem<'_>, subgoals: &mut Vec<Subgoal>) {
    let done = subgoals
        .iter()
        .take_while(|subgoal| {
            matches!(subgoal, Subgoal::Achieve(literal)
                if is_true(problem.physics, problem.state, *literal))
        })
        .count();
    subgoals.drain(..done);
}

/// Drops the leading subgoals that are satisfied already, except for the last subgoal: what the other would
/// undo has to be maintained.
pub(crate) fn drop_satisfied_but_last(problem: &PlanningProblem<'_>, subgoals: &mut Vec<Subgoal>) {
    let last = subgoals.last().copied();
    drop_satisfied(problem, subgoals);
    if subgoals.is_empty() {
        subgoals.extend(last);
    }
}

/// The plan of releasing whatever is held and then staying.
#[must_use]
pub(crate) fn release(problem: &PlanningProblem<'_>, agent: AgentId) -> Plan {
    problem.state.grips[agent].map_or(Plan::STAY, |grip| Plan {
        subgoals: vec![not(Predicate::Attach(agent, grip.object))],
        ..Plan::STAY
    })
}

/// Close(mover, landmark) for each room of a route but the first.
pub(crate) fn rooms(
    route: &Route,
    from: phase_model::Vec2,
    to: phase_model::Vec2,
    mover: Entity,
    subgoals: &mut Vec<Subgoal>,
) {
    if route.length <= from.distance(to) * STRAIGHT {
        return;
    }
    let mut room = room_of(from);
    for &(slot, _) in route.doors() {
        room = slot.beyond(room);
        subgoals.push(is(Predicate::Close(mover, PredicateTarget::Landmark(room.landmark()))));
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
