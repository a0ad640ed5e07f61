//! What is asked of events of several kinds.

use super::Refusal;
use crate::{Outcome, Rest, Track, contact};
use phase_model::{AgentId, Entity, Goal, ObjectId, Relation, Scene, State};

/// For how long something must be done to be seen (steps).
pub(super) const VISIBLE: usize = 3;
/// Steps at the end over which nothing may move.
const AT_THE_END: usize = 4;
/// A goal reached before this step was hardly pursued (2 s of video).
const SOON: usize = 8;
/// How much nearer to what it needs an agent has to come for its goal to be seen (u).
const APPROACH: f32 = 2.0;

/// Adversarial events may last to the maximum length; in all others both agents have released their objects and come
/// to rest.
pub(super) fn tidy(scene: &Scene, track: &Track) -> Result<(), Refusal> {
    if scene.relation() == Relation::Adversarial {
        return Ok(());
    }
    let from = track.steps().saturating_sub(AT_THE_END);
    let still = track.physique.entities().all(|entity| Rest::after(track, entity, from).is_quiet());
    let held = track.states.last().is_some_and(|state| state.grips.iter().any(Option::is_some));
    if still && !held { Ok(()) } else { Err(Refusal::Restless) }
}

/// An agent's goal is reached, and not before one could see it being pursued.
pub(super) fn reached(scene: &Scene, track: &Track, agent: AgentId) -> Result<usize, Refusal> {
    match Outcome::of(track, scene.agents[agent].goal) {
        Outcome { reached: true, steps: Some(steps) } if steps >= SOON => Ok(steps),
        Outcome { reached: true, .. } => Err(Refusal::TooSoon),
        Outcome { reached: false, .. } => Err(Refusal::GoalMissed),
    }
}

/// An agent with a positive goal was seen to be after it: it came clearly nearer to what it has to get to first,
/// or touched it.
pub(super) fn pursued(scene: &Scene, track: &Track, agent: AgentId) -> Result<(), Refusal> {
    let goal = scene.agents[agent].goal;
    let way = |state: &State| first_distance(goal, agent, state);
    let Some(start) = track.states.first().map(way) else { return Err(Refusal::Aimless) };
    let nearest = track.states.iter().map(way).fold(f32::INFINITY, f32::min);
    let touched = match goal {
        Goal::ObjectOnLandmark { object, .. } => touches(track, agent, object) > 0,
        Goal::AgentOnLandmark { .. } | Goal::Touch { .. } => false,
    };
    if touched || start - nearest >= APPROACH { Ok(()) } else { Err(Refusal::Aimless) }
}

/// Steps in which an agent touched or held an object.
pub(super) fn touches(track: &Track, agent: AgentId, object: ObjectId) -> usize {
    contact::steps_touching(track, Entity::Agent(agent), Entity::Object(object)).len()
}

/// The goal's object, if it is about one.
pub(super) const fn object_of(goal: Goal) -> Option<ObjectId> {
    match goal {
        Goal::ObjectOnLandmark { object, .. } => Some(object),
        Goal::AgentOnLandmark { .. } | Goal::Touch { .. } => None,
    }
}

/// How far an agent is from what its goal takes it to first (u).
fn first_distance(goal: Goal, agent: AgentId, state: &State) -> f32 {
    match object_of(goal) {
        Some(object) => state.position(Entity::Agent(agent)).distance(state.position(Entity::Object(object))),
        None => goal.distance(state),
    }
}
