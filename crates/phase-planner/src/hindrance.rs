//! Keeping the other agent from its goal.
//!
//! For every candidate interference, the hinderer computes by A* the resulting cost of the other's best plan,
//! and subtracts a share of its own travel. The estimate therefore accounts for doors, widths and strengths.

use crate::{
    evasion,
    plan::{self, Plan},
    problem::{Location, PlanningProblem, obstruct},
    routes::{Gaps, Routes, point_in},
    search,
    symbolic::Node,
    task::{Effort, Task},
    to_subgoals::to_subgoals,
};
use phase_model::{
    AgentId, BodySet, Entity, Goal, LandmarkId, ObjectId, Predicate, PredicateTarget, Sign, Subgoal, Vec2,
    layout::room_of,
};
use phase_predicates::achieved;

/// Weight of the hinderer's own travel relative to the other's cost.
const EFFORT_WEIGHT: f32 = 0.4;
/// Cap of the effect (u), so that all ways of making the goal infeasible count alike.
const MAX_EFFECT: f32 = 80.0;
/// Value of obstructing the other where no door can be blocked (u).
const OBSTRUCTION_VALUE: f32 = 8.0;
/// Path length by which the hinderer may be behind the other at a door that it tries to block (u).
const MAX_LATENESS: f32 = 1.0;

/// The most effective interference with a goal of the other. A negated goal is hindered by achieving its
/// positive form.
#[must_use]
pub fn plan(problem: &PlanningProblem<'_>, agent: AgentId, goal: Goal) -> Plan {
    let mut candidates = match goal {
        Goal::AgentOnLandmark { sign: Sign::Negative, .. }
        | Goal::ObjectOnLandmark { sign: Sign::Negative, .. } => {
            return achieve_unwanted(problem, agent, goal);
        }
        Goal::AgentOnLandmark { landmark, .. } => obstruct_agent(problem, agent, goal, landmark),
        Goal::ObjectOnLandmark { object, landmark, .. } => {
            obstruct_object(problem, agent, goal, object, landmark)
        }
        Goal::Touch { sign, .. } => vec![evade_or_pursue(problem, agent, sign)],
    };
    // The first of equals, so that the order above breaks ties.
    let mut best: Option<(f32, Plan)> = None;
    for (value, plan) in candidates.drain(..) {
        if best.as_ref().is_none_or(|(highest, _)| value > *highest) {
            best = Some((value, plan));
        }
    }
    best.map_or(Plan::STAY, |(_, plan)| plan)
}

/// Achieves what the other tries to avoid. An agent that is to be on a landmark against its own goal has to
/// be pushed there.
fn achieve_unwanted(problem: &PlanningProblem<'_>, agent: AgentId, goal: Goal) -> Plan {
    let task = single_agent_task(problem, agent, goal, None);
    let subject = goal.subject();
    if let Some(plan) = search::solve(&task, Node::start(problem)) {
        let mut plan = to_subgoals(&task, &plan, agent);
        if let Entity::Object(object) = subject {
            // Since the other would undo it, the object has to be held in place.
            plan.subgoals.retain(|&subgoal| subgoal != plan::not(Predicate::Attach(agent, object)));
        }
        return plan;
    }
    let Some(landmark) = goal.landmark() else { return Plan::STAY };
    let mut subgoals = release_first(problem, agent);
    subgoals.push(plan::is(Predicate::On(subject, landmark)));
    plan::drop_satisfied(problem, &mut subgoals);
    Plan { subgoals, distance: way(problem, agent, problem.state.position(subject)) }
}

fn evade_or_pursue(problem: &PlanningProblem<'_>, agent: AgentId, sign: Sign) -> (f32, Plan) {
    if sign == Sign::Positive {
        return (0.0, evasion::plan(problem, agent));
    }
    let here = problem.state.position(Entity::Agent(agent));
    let there = problem.state.position(Entity::Agent(agent.other()));
    let mut subgoals = Vec::new();
    let route =
        problem.routes.best(here, there, problem.width(agent, None), problem.gaps(agent, BodySet::OBJECTS));
    if let Some(route) = &route {
        plan::rooms(route, here, there, Entity::Agent(agent), &mut subgoals);
    }
    subgoals.push(plan::is(Predicate::Touch(agent, Entity::Agent(agent.other()))));
    (0.0, Plan { subgoals, distance: route.map_or(0.0, |route| route.length) })
}

/// Block a door on the other's path, or stand between it and its landmark.
fn obstruct_agent(
    problem: &PlanningProblem<'_>,
    agent: AgentId,
    goal: Goal,
    landmark: LandmarkId,
) -> Vec<(f32, Plan)> {
    let victim = agent.other();
    let base = other_cost(problem, victim, goal, without_held_object(problem, agent), None);
    let target = problem.position(Location::Landmark(landmark));
    let there = problem.state.position(Entity::Agent(victim));
    let mut candidates = block_doors(problem, agent, goal, there, target, base);
    let between = target + (there - target).clamp_length_max(guard_distance(problem));
    let way = way(problem, agent, between);
    let mut subgoals = release_first(problem, agent);
    if room_of(problem.state.position(Entity::Agent(agent))) != landmark.room() && way > 6.0 {
        approach_rooms(problem, agent, between, &mut subgoals);
    }
    subgoals.push(plan::not(Predicate::On(Entity::Agent(victim), landmark)));
    candidates.push((base + OBSTRUCTION_VALUE - EFFORT_WEIGHT * way, Plan { subgoals, distance: way }));
    candidates
}

/// Each door on the other's path that the hinderer's body can close and that it can reach in time.
fn block_doors(
    problem: &PlanningProblem<'_>,
    agent: AgentId,
    goal: Goal,
    from: Vec2,
    to: Vec2,
    base: f32,
) -> Vec<(f32, Plan)> {
    let victim = agent.other();
    let width = problem.width(victim, None);
    let Some(route) = problem.routes.best(from, to, width, problem.gaps(victim, BodySet::OBJECTS)) else {
        return Vec::new();
    };
    let mut candidates = Vec::new();
    let mut room = room_of(from);
    for &(slot, _) in route.doors() {
        let next = Routes::neighbour_across(slot, room);
        let gap = problem.routes.gaps().0[slot];
        room = next;
        let Some((low, high)) = gap else { continue };
        let middle = point_in(slot, 0.5 * (low + high));
        let gaps = gaps_with_blocker(problem, agent, victim, middle);
        let effect = other_cost(problem, victim, goal, without_held_object(problem, agent), Some(gaps));
        let own_way = way(problem, agent, middle);
        if effect <= base + 1.0 || own_way > from.distance(middle) + MAX_LATENESS {
            continue;
        }
        let mut subgoals = release_first(problem, agent);
        subgoals.push(plan::not(Predicate::Close(
            Entity::Agent(victim),
            PredicateTarget::Landmark(next.landmark()),
        )));
        candidates.push((
            effect.min(base + MAX_EFFECT) - EFFORT_WEIGHT * own_way,
            Plan { subgoals, distance: own_way },
        ));
    }
    candidates
}

/// The doors as they are for the other agent when the hinderer stands in one.
fn gaps_with_blocker(problem: &PlanningProblem<'_>, agent: AgentId, victim: AgentId, at: Vec2) -> Gaps {
    let mut gaps = *problem.gaps(victim, BodySet::OBJECTS);
    let half_width = 0.5 * problem.width(agent, None);
    obstruct(&mut gaps, at, half_width, half_width);
    gaps
}

/// Take the object away, pull against the other, or otherwise obstruct the other.
fn obstruct_object(
    problem: &PlanningProblem<'_>,
    agent: AgentId,
    goal: Goal,
    object: ObjectId,
    landmark: LandmarkId,
) -> Vec<(f32, Plan)> {
    let victim = agent.other();
    let start = Node::start(problem);
    let free = without_held_object(problem, agent);
    let base = other_cost(problem, victim, goal, free, None);
    let task = single_agent_task(problem, agent, goal, None);
    let me = Entity::Agent(agent);
    let location = Location::Current(Entity::Object(object));
    let holding = problem.state.held_object(agent) == Some(object);
    let contested = problem.state.held_object(victim) == Some(object);
    let fetch = if holding { 0.0 } else { task.distance(&start, agent, None, location, Some(object)) };
    let mut candidates = Vec::new();
    for refuge in LandmarkId::ALL.into_iter().filter(|&refuge| refuge != landmark) {
        let mut after = free;
        after.objects[object] = Location::Landmark(refuge);
        after.holds[victim] = None;
        let effect = other_cost(problem, victim, goal, after, None).min(base + MAX_EFFECT);
        let mut carrying = start;
        carrying.holds[agent] = Some(object);
        let carry = task.distance(&carrying, agent, Some(object), Location::Landmark(refuge), Some(object));
        let mut subgoals = Vec::new();
        if !holding {
            subgoals = release_first(problem, agent);
            approach_rooms(problem, agent, problem.position(location), &mut subgoals);
            subgoals.push(plan::is(Predicate::Close(me, PredicateTarget::Entity(Entity::Object(object)))));
            subgoals.push(plan::is(Predicate::Attach(agent, object)));
        }
        let (from, to) = (problem.position(location), problem.position(Location::Landmark(refuge)));
        let width = problem.width(agent, Some(object));
        let gaps = task.gaps(&carrying, agent, Some(object));
        if let Some(route) = problem.routes.best(from, to, width, &gaps) {
            plan::rooms(&route, from, to, Entity::Object(object), &mut subgoals);
        }
        subgoals.push(plan::is(Predicate::On(Entity::Object(object), refuge)));
        plan::drop_satisfied(problem, &mut subgoals);
        let mut holders = plan::only(agent);
        holders[victim] = false;
        let feasible = problem.net_force(holders) > 0.0 || contested;
        if feasible {
            let value = effect - EFFORT_WEIGHT * (fetch + carry);
            candidates.push((value, Plan { subgoals, distance: fetch + carry }));
        }
    }
    if achieved(problem.physics, problem.state, goal) {
        return candidates;
    }
    let target = problem.position(Location::Landmark(landmark));
    candidates.extend(block_doors(problem, agent, goal, problem.position(location), target, base));
    if candidates.is_empty() {
        let mut subgoals = release_first(problem, agent);
        approach_rooms(problem, agent, target, &mut subgoals);
        subgoals.push(plan::not(Predicate::On(Entity::Object(object), landmark)));
        plan::drop_satisfied(problem, &mut subgoals);
        candidates.push((0.0, Plan { subgoals, distance: way(problem, agent, target) }));
    }
    candidates
}

/// The present symbolic state with the hinderer's hands free, so that releasing does not appear effective
/// merely because holding is.
fn without_held_object(problem: &PlanningProblem<'_>, agent: AgentId) -> Node {
    let mut node = Node::start(problem);
    node.holds[agent] = None;
    node
}

/// The cost of the other's best plan from a symbolic state, acting alone.
fn other_cost(
    problem: &PlanningProblem<'_>,
    other: AgentId,
    goal: Goal,
    node: Node,
    narrowed: Option<Gaps>,
) -> f32 {
    search::solve(&single_agent_task(problem, other, goal, narrowed), node).map_or(f32::MAX, |plan| plan.cost)
}

/// The task of one agent that acts alone and against the other, which may have narrowed doors for it.
fn single_agent_task<'a>(
    problem: &'a PlanningProblem<'a>,
    agent: AgentId,
    goal: Goal,
    narrowed: Option<Gaps>,
) -> Task<'a> {
    Task {
        problem,
        goal,
        actors: plan::only(agent),
        efforts: [Effort::OWN; 2],
        cooperative: false,
        narrowed: narrowed.map(|gaps| (agent, gaps)),
    }
}

/// Distance at which a guard stands before a landmark (u): both bodies' radii.
fn guard_distance(problem: &PlanningProblem<'_>) -> f32 {
    problem.physics.agents.iter().map(|body| body.radius).sum()
}

fn way(problem: &PlanningProblem<'_>, agent: AgentId, to: Vec2) -> f32 {
    let from = problem.state.position(Entity::Agent(agent));
    problem.routes.cost(from, to, problem.width(agent, None), problem.gaps(agent, BodySet::OBJECTS))
}

fn approach_rooms(problem: &PlanningProblem<'_>, agent: AgentId, to: Vec2, subgoals: &mut Vec<Subgoal>) {
    let from = problem.state.position(Entity::Agent(agent));
    let width = problem.width(agent, None);
    if let Some(route) = problem.routes.best(from, to, width, problem.gaps(agent, BodySet::OBJECTS)) {
        plan::rooms(&route, from, to, Entity::Agent(agent), subgoals);
    }
}

fn release_first(problem: &PlanningProblem<'_>, agent: AgentId) -> Vec<Subgoal> {
    plan::release(problem, agent).subgoals
}
