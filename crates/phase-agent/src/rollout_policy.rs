//! The heuristic rollout policy: steers along the path; the other rollout actions are uniformly random.

use crate::{objective::Objective, steering::Steering};
use phase_model::{Action, Entity, Literal, Predicate, State, Subgoal, Vec2, arena};

/// Seconds of physics in one step.
const STEP_SECONDS: f32 = arena::SUBSTEP_SECONDS * arena::SUBSTEPS as f32;
/// Heading error below which the policy pushes forward (rad).
const HEADING_TOLERANCE: f32 = 0.6;
/// Speed below which the policy does not brake (u/s).
const BRAKING_SPEED: f32 = 1.0;

/// The action of the heuristic: attach or detach where that is the subgoal; brake before overshooting; apply
/// the push closest to the direction of the waypoint; or, if sideways pushes are not among the `actions`,
/// turn until the heading error is small, stepping back where that is available and the waypoint lies behind.
/// `steering` is the state's steering if it is known already.
#[must_use]
pub fn action(
    objective: &Objective<'_>,
    state: &State,
    steering: Option<Steering>,
    actions: &[Action],
) -> Action {
    let agent = objective.agent;
    if let Subgoal::Achieve(Literal { predicate: Predicate::Attach(who, object), holds }) = objective.subgoal
        && who == agent
    {
        let within_reach =
            state.attachable(objective.physics, agent).is_some_and(|(nearest, _)| nearest == object);
        match (holds, state.holds(agent, object)) {
            (true, false) if within_reach => return Action::Attach,
            (false, true) => return Action::Detach,
            (true, true) | (false, false) => return Action::Stop,
            _ => {}
        }
    }
    let steering = steering.unwrap_or_else(|| objective.steering(state));
    let moved_entity = state.body(objective.moved_entity(state));
    let way = steering.waypoint - moved_entity.position;
    let body = state.body(Entity::Agent(agent));
    let speed = body.velocity.length();
    let distance = way.length();
    if distance < 0.2 || (speed > BRAKING_SPEED && overshoots(body.velocity, way, speed, distance)) {
        return Action::Stop;
    }
    let direction = way / distance;
    let forward = body.forward();
    if actions.contains(&Action::Left) {
        let right = Vec2::new(forward.y, -forward.x);
        return nearest_push(Vec2::new(direction.dot(right), direction.dot(forward)));
    }
    let off = libm::atan2f(forward.perp_dot(direction), forward.dot(direction));
    if off.abs() < HEADING_TOLERANCE {
        Action::Up
    } else if off.abs() > core::f32::consts::FRAC_PI_2 && actions.contains(&Action::Down) {
        Action::Down
    } else if off > 0.0 {
        Action::TurnLeft
    } else {
        Action::TurnRight
    }
}

/// Whether the present velocity overshoots the waypoint, or moves clearly away from it, within this step.
fn overshoots(velocity: Vec2, way: Vec2, speed: f32, distance: f32) -> bool {
    let towards = velocity.dot(way) / (speed * distance);
    towards < 0.5 || speed * STEP_SECONDS > distance
}

/// The push nearest to a direction in the agent's frame (x right, y forward).
fn nearest_push(direction: Vec2) -> Action {
    let mut best = (f32::NEG_INFINITY, Action::Up);
    for action in Action::ALL {
        if let Some(push) = action.push() {
            let along = push.dot(direction);
            if along > best.0 {
                best = (along, action);
            }
        }
    }
    best.1
}
