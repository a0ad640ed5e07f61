//! Checks shared by several kinds of event.

use super::{FINAL_REST_STEPS, RejectionReason};
pub(super) use crate::manner::goal_object as object_of;
use crate::{GoalOutcome, Rest, Track, contact};
use phase_model::{AgentId, Entity, Goal, ObjectId, Relation, Scene, State};

/// A goal reached before this step was hardly pursued visibly (2 s of video).
const MIN_STEPS_TO_GOAL: usize = 8;
/// Least approach of an agent to its first target for its goal to be visible (u).
const MIN_APPROACH: f32 = 2.0;

/// Adversarial events may last to the maximum length; in all others both agents have released their objects
/// and come to rest.
pub(super) fn check_rest_at_end(scene: &Scene, track: &Track) -> Result<(), RejectionReason> {
    if scene.relation() == Relation::Adversarial {
        return Ok(());
    }
    let from = track.steps().saturating_sub(FINAL_REST_STEPS);
    let still = track.physics.entities().all(|entity| Rest::after(track, entity, from).is_at_rest());
    let held = track.states.last().is_some_and(|state| state.grips.iter().any(Option::is_some));
    if still && !held { Ok(()) } else { Err(RejectionReason::Restless) }
}

/// An agent's goal is reached, and not before its pursuit was visible.
pub(super) fn reached(scene: &Scene, track: &Track, agent: AgentId) -> Result<usize, RejectionReason> {
    match GoalOutcome::of(track, scene.agents[agent].goal) {
        GoalOutcome { reached: true, steps: Some(steps) } if steps >= MIN_STEPS_TO_GOAL => Ok(steps),
        GoalOutcome { reached: true, .. } => Err(RejectionReason::TooSoon),
        GoalOutcome { reached: false, .. } => Err(RejectionReason::GoalMissed),
    }
}

/// An agent with a positive goal was seen to pursue it: it came clearly closer to its first target, or
/// touched it.
pub(super) fn pursued(scene: &Scene, track: &Track, agent: AgentId) -> Result<(), RejectionReason> {
    let goal = scene.agents[agent].goal;
    let way = |state: &State| first_distance(goal, agent, state);
    let Some(start) = track.states.first().map(way) else { return Err(RejectionReason::Aimless) };
    let nearest = track.states.iter().map(way).fold(f32::INFINITY, f32::min);
    let touched = match goal {
        Goal::ObjectOnLandmark { object, .. } => touches(track, agent, object) > 0,
        Goal::AgentOnLandmark { .. } | Goal::Touch { .. } => false,
    };
    if touched || start - nearest >= MIN_APPROACH { Ok(()) } else { Err(RejectionReason::Aimless) }
}

/// Steps in which an agent touched or held an object.
pub(super) fn touches(track: &Track, agent: AgentId, object: ObjectId) -> usize {
    contact::steps_touching(track, Entity::Agent(agent), Entity::Object(object)).len()
}

pub(super) const fn require(holds: bool, otherwise: RejectionReason) -> Result<(), RejectionReason> {
    if holds { Ok(()) } else { Err(otherwise) }
}

/// Distance of an agent from the first target of its goal (u).
fn first_distance(goal: Goal, agent: AgentId, state: &State) -> f32 {
    match object_of(goal) {
        Some(object) => state.position(Entity::Agent(agent)).distance(state.position(Entity::Object(object))),
        None => goal.distance(state),
    }
}
