//! Keeping the other agent from its goal.
//!
//! For every candidate interference, the hinderer computes by A* what the other's best plan would then
//! cost, and subtracts a share of its own travel. The estimate therefore accounts for doors, widths and
//! strengths.

use crate::{
    express::express,
    flight,
    plan::{self, Plan},
    routes::{Gaps, Routes, point_in},
    search,
    situation::{Situation, Spot, obstruct},
    symbolic::Node,
    task::Task,
};
use phase_model::{
    AgentId, BodySet, Entity, Goal, LandmarkId, ObjectId, Place, Predicate, Sign, Subgoal, Vec2,
    layout::room_of,
};
use phase_predicates::achieved;

/// Weight of the hinderer's own travel relative to the other's cost.
const EFFORT: f32 = 0.4;
/// Cap of the effect (u), so that all ways of making the goal infeasible count alike.
const GREATEST_EFFECT: f32 = 80.0;
/// Value of obstructing the other where no door can be blocked (u).
const IN_THE_WAY: f32 = 8.0;
/// Path length by which the hinderer may be behind the other at a door that it tries to block (u).
const LATE: f32 = 1.0;

/// The most effective interference with a goal of the other. A negated goal is hindered by achieving its
/// positive form.
#[must_use]
pub fn plan(situation: &Situation<'_>, agent: AgentId, goal: Goal) -> Plan {
    let mut candidates = match goal {
        Goal::AgentOnLandmark { sign: Sign::Negative, .. }
        | Goal::ObjectOnLandmark { sign: Sign::Negative, .. } => {
            return bring_about(situation, agent, goal);
        }
        Goal::AgentOnLandmark { landmark, .. } => keep_agent_off(situation, agent, goal, landmark),
        Goal::ObjectOnLandmark { object, landmark, .. } => {
            keep_object_off(situation, agent, goal, object, landmark)
        }
        Goal::Touch { sign, .. } => vec![evade_or_pursue(situation, agent, sign)],
    };
    // The first of equals, so that the order above decides ties.
    let mut best: Option<(f32, Plan)> = None;
    for (value, plan) in candidates.drain(..) {
        if best.as_ref().is_none_or(|(highest, _)| value > *highest) {
            best = Some((value, plan));
        }
    }
    best.map_or(Plan::STAY, |(_, plan)| plan)
}

/// Achieves what the other tries to avoid. An agent that is to be on a landmark against its own goal has to be pushed
/// there.
fn bring_about(situation: &Situation<'_>, agent: AgentId, goal: Goal) -> Plan {
    let task = lone_task(situation, agent, goal, None);
    let subject = goal.subject();
    if let Some(plan) = search::solve(&task, Node::start(situation)) {
        let mut plan = express(&task, &plan, agent);
        if let Entity::Object(object) = subject {
            // Since the other would undo it, the object has to be held in place.
            plan.subgoals.retain(|&subgoal| subgoal != plan::not(Predicate::Attach(agent, object)));
        }
        return plan;
    }
    let Some(landmark) = goal.landmark() else { return Plan::STAY };
    let mut subgoals = let_go_first(situation, agent);
    subgoals.push(plan::is(Predicate::On(subject, landmark)));
    plan::skip_done(situation, &mut subgoals);
    Plan { subgoals, distance: way(situation, agent, situation.state.position(subject)) }
}

fn evade_or_pursue(situation: &Situation<'_>, agent: AgentId, sign: Sign) -> (f32, Plan) {
    if sign == Sign::Positive {
        return (0.0, flight::plan(situation, agent));
    }
    let here = situation.state.position(Entity::Agent(agent));
    let there = situation.state.position(Entity::Agent(agent.other()));
    let mut subgoals = Vec::new();
    let route = situation.routes.best(
        here,
        there,
        situation.width(agent, None),
        situation.gaps(agent, BodySet::OBJECTS),
    );
    if let Some(route) = &route {
        plan::rooms(route, here, there, Entity::Agent(agent), &mut subgoals);
    }
    subgoals.push(plan::is(Predicate::Touch(agent, Entity::Agent(agent.other()))));
    (0.0, Plan { subgoals, distance: route.map_or(0.0, |route| route.length) })
}

/// Block a door on the other's way, or stand between it and its landmark.
fn keep_agent_off(
    situation: &Situation<'_>,
    agent: AgentId,
    goal: Goal,
    landmark: LandmarkId,
) -> Vec<(f32, Plan)> {
    let victim = agent.other();
    let base = other_cost(situation, victim, goal, hands_free(situation, agent), None);
    let target = situation.position(Spot::Landmark(landmark));
    let there = situation.state.position(Entity::Agent(victim));
    let mut candidates = block_doors(situation, agent, goal, there, target, base);
    let between = target + (there - target).clamp_length_max(guard_distance(situation));
    let way = way(situation, agent, between);
    let mut subgoals = let_go_first(situation, agent);
    if room_of(situation.state.position(Entity::Agent(agent))) != landmark.room() && way > 6.0 {
        approach_rooms(situation, agent, between, &mut subgoals);
    }
    subgoals.push(plan::not(Predicate::On(Entity::Agent(victim), landmark)));
    candidates.push((base + IN_THE_WAY - EFFORT * way, Plan { subgoals, distance: way }));
    candidates
}

/// Each door on the other's way that the hinderer's body can close and that it can reach in time.
fn block_doors(
    situation: &Situation<'_>,
    agent: AgentId,
    goal: Goal,
    from: Vec2,
    to: Vec2,
    base: f32,
) -> Vec<(f32, Plan)> {
    let victim = agent.other();
    let width = situation.width(victim, None);
    let Some(route) = situation.routes.best(from, to, width, situation.gaps(victim, BodySet::OBJECTS)) else {
        return Vec::new();
    };
    let mut candidates = Vec::new();
    let mut room = room_of(from);
    for &(slot, _) in route.doors() {
        let next = Routes::beyond(slot, room);
        let gap = situation.routes.gaps().0[slot];
        room = next;
        let Some((low, high)) = gap else { continue };
        let middle = point_in(slot, 0.5 * (low + high));
        let gaps = closed_by(situation, agent, victim, middle);
        let effect = other_cost(situation, victim, goal, hands_free(situation, agent), Some(gaps));
        let own_way = way(situation, agent, middle);
        if effect <= base + 1.0 || own_way > from.distance(middle) + LATE {
            continue;
        }
        let mut subgoals = let_go_first(situation, agent);
        subgoals.push(plan::not(Predicate::Close(Entity::Agent(victim), Place::Landmark(next.landmark()))));
        candidates.push((
            effect.min(base + GREATEST_EFFECT) - EFFORT * own_way,
            Plan { subgoals, distance: own_way },
        ));
    }
    candidates
}

/// The doors as the victim finds them when the hinderer stands in one.
fn closed_by(situation: &Situation<'_>, agent: AgentId, victim: AgentId, at: Vec2) -> Gaps {
    let mut gaps = *situation.gaps(victim, BodySet::OBJECTS);
    let half_width = 0.5 * situation.width(agent, None);
    obstruct(&mut gaps, at, half_width, half_width);
    gaps
}

/// Take the object away, pull against the other, or failing that stand in the way.
fn keep_object_off(
    situation: &Situation<'_>,
    agent: AgentId,
    goal: Goal,
    object: ObjectId,
    landmark: LandmarkId,
) -> Vec<(f32, Plan)> {
    let victim = agent.other();
    let start = Node::start(situation);
    let free = hands_free(situation, agent);
    let base = other_cost(situation, victim, goal, free, None);
    let task = lone_task(situation, agent, goal, None);
    let me = Entity::Agent(agent);
    let spot = Spot::Now(Entity::Object(object));
    let holding = situation.state.held_object(agent) == Some(object);
    let contested = situation.state.held_object(victim) == Some(object);
    let fetch = if holding { 0.0 } else { task.distance(&start, agent, None, spot) };
    let mut candidates = Vec::new();
    for refuge in LandmarkId::ALL.into_iter().filter(|&refuge| refuge != landmark) {
        let mut after = free;
        after.objects[object] = Spot::Landmark(refuge);
        after.holds[victim] = None;
        let effect = other_cost(situation, victim, goal, after, None).min(base + GREATEST_EFFECT);
        let mut carrying = start;
        carrying.holds[agent] = Some(object);
        let carry = task.distance(&carrying, agent, Some(object), Spot::Landmark(refuge));
        let mut subgoals = Vec::new();
        if !holding {
            subgoals = let_go_first(situation, agent);
            approach_rooms(situation, agent, situation.position(spot), &mut subgoals);
            subgoals.push(plan::is(Predicate::Close(me, Place::Entity(Entity::Object(object)))));
            subgoals.push(plan::is(Predicate::Attach(agent, object)));
        }
        let (from, to) = (situation.position(spot), situation.position(Spot::Landmark(refuge)));
        let width = situation.width(agent, Some(object));
        let gaps = task.gaps(&carrying, agent, Some(object));
        if let Some(route) = situation.routes.best(from, to, width, &gaps) {
            plan::rooms(&route, from, to, Entity::Object(object), &mut subgoals);
        }
        subgoals.push(plan::is(Predicate::On(Entity::Object(object), refuge)));
        plan::skip_done(situation, &mut subgoals);
        let mut holders = plan::only(agent);
        holders[victim] = false;
        let feasible = situation.net_force(holders) > 0.0 || contested;
        if feasible {
            let value = effect - EFFORT * (fetch + carry);
            candidates.push((value, Plan { subgoals, distance: fetch + carry }));
        }
    }
    if achieved(situation.physique, situation.state, goal) {
        return candidates;
    }
    let target = situation.position(Spot::Landmark(landmark));
    candidates.extend(block_doors(situation, agent, goal, situation.position(spot), target, base));
    if candidates.is_empty() {
        let mut subgoals = let_go_first(situation, agent);
        approach_rooms(situation, agent, target, &mut subgoals);
        subgoals.push(plan::not(Predicate::On(Entity::Object(object), landmark)));
        plan::skip_done(situation, &mut subgoals);
        candidates.push((0.0, Plan { subgoals, distance: way(situation, agent, target) }));
    }
    candidates
}

/// The present symbolic state with the hinderer's hands free, so that releasing does not appear effective
/// only because holding is.
fn hands_free(situation: &Situation<'_>, agent: AgentId) -> Node {
    let mut node = Node::start(situation);
    node.holds[agent] = None;
    node
}

/// What the other's best plan costs from a symbolic state, acting alone.
fn other_cost(
    situation: &Situation<'_>,
    other: AgentId,
    goal: Goal,
    node: Node,
    narrowed: Option<Gaps>,
) -> f32 {
    search::solve(&lone_task(situation, other, goal, narrowed), node).map_or(f32::MAX, |plan| plan.cost)
}

/// The task of one agent that acts alone and against the other, which may have narrowed doors for it.
fn lone_task<'a>(
    situation: &'a Situation<'a>,
    agent: AgentId,
    goal: Goal,
    narrowed: Option<Gaps>,
) -> Task<'a> {
    Task {
        situation,
        goal,
        actors: plan::only(agent),
        effort: [1.0; 2],
        allied: false,
        narrowed: narrowed.map(|gaps| (agent, gaps)),
    }
}

/// Distance at which a guard stands before a landmark (u): both bodies' radii.
fn guard_distance(situation: &Situation<'_>) -> f32 {
    situation.physique.agents.iter().map(|body| body.radius).sum()
}

fn way(situation: &Situation<'_>, agent: AgentId, to: Vec2) -> f32 {
    let from = situation.state.position(Entity::Agent(agent));
    situation.routes.cost(from, to, situation.width(agent, None), situation.gaps(agent, BodySet::OBJECTS))
}

fn approach_rooms(situation: &Situation<'_>, agent: AgentId, to: Vec2, subgoals: &mut Vec<Subgoal>) {
    let from = situation.state.position(Entity::Agent(agent));
    let width = situation.width(agent, None);
    if let Some(route) = situation.routes.best(from, to, width, situation.gaps(agent, BodySet::OBJECTS)) {
        plan::rooms(&route, from, to, Entity::Agent(agent), subgoals);
    }
}

fn let_go_first(situation: &Situation<'_>, agent: AgentId) -> Vec<Subgoal> {
    plan::let_go(situation, agent).subgoals
}
