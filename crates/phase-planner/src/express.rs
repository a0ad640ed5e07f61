//! A symbolic plan in the words of the subgoal space.

use crate::{
    plan::{Plan, is, not, rooms, skip_done},
    routes::Routes,
    search::SymbolicPlan,
    situation::Spot,
    symbolic::{Node, Operator},
    task::Task,
};
use phase_model::{AgentId, Entity, ObjectId, Place, Predicate, Subgoal};

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
