//! The heuristic rollout policy: steers along the way; the other rollout actions are uniformly random.

use crate::objective::Objective;
use phase_model::{Action, AgentId, Entity, State, Vec2, arena};

/// The action of the heuristic: attach or detach where that is the subgoal; stop at the end of the way; with
/// an object in hand, apply the push closest to the direction of the waypoint; with free hands, turn until
/// the heading error is small, then push forward.
#[must_use]
pub fn action(objective: &Objective<'_>, state: &State) -> Action {
    let agent = objective.agent();
    let parameters = objective.parameters();
    if objective.releases(state) {
        return Action::Detach;
    }
    if let Some(object) = objective.wanted_object(state)
        && state.attachable(objective.physics(), agent).is_some_and(|(nearest, _)| nearest == object)
    {
        return Action::Attach;
    }
    let motion = objective.motion(state);
    let way = motion.waypoint - state.position(motion.entity);
    let distance = way.length();
    if distance < parameters.arrival_distance && motion.turn != 0.0 {
        return if motion.turn > 0.0 { Action::TurnLeft } else { Action::TurnRight };
    }
    let body = state.body(Entity::Agent(agent));
    let reach = body.velocity.length() * arena::STEP_SECONDS as f32;
    if distance < parameters.arrival_distance || reach > distance {
        return Action::Stop;
    }
    let direction = way / distance;
    if is_free(state, agent) {
        walk(body.forward(), direction, parameters.heading_tolerance)
    } else {
        push(body.forward(), direction)
    }
}

/// Whether an agent has free hands.
pub(crate) fn is_free(state: &State, agent: AgentId) -> bool {
    state.grips[agent].is_none()
}

/// Turning to a direction, or forward if the heading deviates from it by less than `tolerance` (rad).
fn walk(forward: Vec2, direction: Vec2, tolerance: f32) -> Action {
    let off = libm::atan2f(forward.perp_dot(direction), forward.dot(direction));
    if off.abs() < tolerance {
        Action::Up
    } else if off > 0.0 {
        Action::TurnLeft
    } else {
        Action::TurnRight
    }
}

/// The push nearest to a direction.
fn push(forward: Vec2, direction: Vec2) -> Action {
    let right = Vec2::new(forward.y, -forward.x);
    let in_frame = Vec2::new(direction.dot(right), direction.dot(forward));
    let mut best = (f32::NEG_INFINITY, Action::Up);
    for action in Action::ALL {
        if let Some(push) = action.push() {
            let along = push.dot(in_frame);
            if along > best.0 {
                best = (along, action);
            }
        }
    }
    best.1
}
