//! Translation of a symbolic plan into subgoals.

use crate::{
    plan::{Plan, drop_satisfied, is, not, rooms},
    problem::Location,
    symbolic::{Node, Operator},
    task::{PlanningTask, TaskPlan},
};
use phase_model::{AgentId, Entity, ObjectId, Predicate, PredicateTarget, Subgoal};

/// One agent's own part of a symbolic plan as subgoals, and the distance that all agents have to travel.
#[must_use]
pub(crate) fn to_subgoals(task: &PlanningTask<'_>, plan: &TaskPlan, agent: AgentId) -> Plan {
    let mut subgoals = Vec::with_capacity(8);
    let mut distance = 0.0;
    for (node, operator) in &plan.steps {
        distance += travel(task, node, *operator);
        match *operator {
            Operator::Approach { agent: who, object } if who == agent => {
                let location = node.objects[object];
                go(task, node, agent, None, Some(object), location, &mut subgoals);
                let target = PredicateTarget::Entity(Entity::Object(object));
                subgoals.push(is(Predicate::Close(Entity::Agent(agent), target)));
            }
            Operator::Meet { agent: who } if who == agent => {
                go(task, node, agent, None, None, node.agents[agent.other()], &mut subgoals);
                subgoals.push(is(Predicate::Touch(agent, Entity::Agent(agent.other()))));
            }
            Operator::Go { agent: who, landmark } if who == agent => {
                go(task, node, agent, None, None, Location::Landmark(landmark), &mut subgoals);
                subgoals.push(is(Predicate::On(Entity::Agent(agent), landmark)));
            }
            Operator::Grab { agent: who, object } if who == agent => {
                subgoals.push(is(Predicate::Attach(agent, object)));
            }
            Operator::Carry { object, landmark, .. } if node.holds[agent] == Some(object) => {
                go(task, node, agent, Some(object), None, Location::Landmark(landmark), &mut subgoals);
                subgoals.push(is(Predicate::On(Entity::Object(object), landmark)));
            }
            Operator::Pass { agent: who, object, slot, room } if who == agent => {
                let near = slot.beyond(room);
                go(
                    task,
                    node,
                    agent,
                    Some(object),
                    None,
                    Location::Inside { slot, room: near },
                    &mut subgoals,
                );
                let place = PredicateTarget::Landmark(room.landmark());
                subgoals.push(is(Predicate::Close(Entity::Object(object), place)));
                subgoals.push(not(Predicate::Attach(agent, object)));
            }
            Operator::Release { agent: who, object } if who == agent => {
                subgoals.push(not(Predicate::Attach(agent, object)));
            }
            _ => {}
        }
    }
    drop_satisfied(task.problem, &mut subgoals);
    Plan { subgoals, distance, is_feasible: plan.cost < task.problem.parameters.impassable }
}

/// Distance travelled in one operator, by whichever agent (u).
fn travel(task: &PlanningTask<'_>, node: &Node, operator: Operator) -> f32 {
    match operator {
        Operator::Approach { agent, object } => {
            task.distance(node, agent, None, node.objects[object], Some(object))
        }
        Operator::Meet { agent } => task.distance(node, agent, None, node.agents[agent.other()], None),
        Operator::Go { agent, landmark } => {
            task.distance(node, agent, None, Location::Landmark(landmark), None)
        }
        Operator::Carry { agent, object, landmark } => {
            task.distance(node, agent, Some(object), Location::Landmark(landmark), Some(object))
        }
        Operator::Pass { agent, object, slot, room } => {
            let near = slot.beyond(room);
            task.distance(node, agent, Some(object), Location::Inside { slot, room: near }, Some(object))
        }
        Operator::Grab { .. } | Operator::Release { .. } => 0.0,
    }
}

/// The rooms on the path to a location, as Close(·, landmark) subgoals for the agent or for its load. Rooms
/// that the straight line passes through anyway do not become subgoals.
fn go(
    task: &PlanningTask<'_>,
    node: &Node,
    agent: AgentId,
    held: Option<ObjectId>,
    heads_for: Option<ObjectId>,
    location: Location,
    subgoals: &mut Vec<Subgoal>,
) {
    let problem = task.problem;
    let from_spot = held.map_or(node.agents[agent], |object| node.objects[object]);
    let from = problem.position(from_spot);
    let to = problem.position(location);
    let mover = held.map_or(Entity::Agent(agent), Entity::Object);
    let width = problem.width(agent, held);
    let gaps = task.gaps(node, agent, held.or(heads_for));
    if let Some(route) = problem.route(from, to, width, &gaps) {
        rooms(&route, from, to, mover, subgoals);
    }
}
