//! The place at which an agent looks for an object that was moved while it waited.

use crate::Track;
use phase_model::{AgentId, Entity, Vec2, layout::room_of};
use phase_perception::{Cell, Observation, observe};

/// The first look of an agent, once it acts, at an object or at the place that the object has left.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct FirstLook {
    /// The step at which it sees either.
    pub step: usize,
    /// Whether it sees the place that the object has left.
    pub at_old_place: bool,
    /// Way by which it has come closer, since it acts, to the body or place that it then sees (u).
    pub approach: f32,
}

/// Whether an object is in another room after `waits` steps than at the start; false for shorter tracks.
#[must_use]
pub fn was_moved(track: &Track, object: Entity, waits: usize) -> bool {
    let room = |state: &phase_model::State| room_of(state.position(object));
    let ends = (track.states.first(), track.states.get(waits));
    matches!(ends, (Some(start), Some(then)) if room(start) != room(then))
}

/// Whether an agent that waits for some steps sees in none of them the object or the place where that was at
/// the start.
#[must_use]
pub fn missed(track: &Track, agent: AgentId, object: Entity, waits: usize) -> bool {
    !track.states.is_empty()
        && (0..track.states.len().min(waits + 1)).all(|t| !notices(track, agent, object, t))
}

/// Whether an agent perceives, after `steps` steps, an object or the place where that was at the start.
///
/// # Panics
/// If the track is shorter.
#[must_use]
pub fn notices(track: &Track, agent: AgentId, object: Entity, steps: usize) -> bool {
    let seen = observe(&track.physics, &track.states[steps], agent);
    seen.observed.contains(object) || sees_place(track, &seen, object, track.states[0].position(object))
}

/// The first look of an agent that has waited for some steps; `None` if it sees neither.
#[must_use]
pub fn first_look(track: &Track, agent: AgentId, object: Entity, waits: usize) -> Option<FirstLook> {
    let old = track.states.first()?.position(object);
    let me = Entity::Agent(agent);
    let from = track.states.get(waits)?.position(me);
    track.states.iter().enumerate().skip(waits).find_map(|(step, state)| {
        let seen = observe(&track.physics, state, agent);
        let at_old_place = sees_place(track, &seen, object, old);
        (at_old_place || seen.observed.contains(object)).then(|| {
            let place = if at_old_place { old } else { state.position(object) };
            let approach = from.distance(place) - state.position(me).distance(place);
            FirstLook { step, at_old_place, approach }
        })
    })
}

/// Whether an observation shows a part of the place that an object took at a position.
fn sees_place(track: &Track, seen: &Observation, object: Entity, place: Vec2) -> bool {
    let radius = Vec2::splat(track.physics.radius(object));
    Cell::in_box(place - radius, place + radius).any(|cell| seen.sees_cell(cell))
}
