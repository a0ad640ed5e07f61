//! The kinds of pursuit that a subgoal asks for.

use super::{
    carry::Carry,
    guard::{ClearPath, Guard},
    own_way::OwnWay,
    way::Way,
};
use crate::PhaseParameters;
use phase_model::{Entity, LandmarkId, ObjectId, Vec2, arena};
use phase_navigation::Target;

/// The kinds of distance to go.
#[derive(Clone, Debug)]
pub(crate) enum Pursuit {
    /// Nothing.
    Rest,
    /// Be at a target.
    BeAt(OwnWay),
    /// Be next to an entity.
    Meet(Entity, Way),
    /// Hold an object.
    Grasp(ObjectId, Way),
    /// Release an object, and leave it at rest.
    Release(ObjectId),
    /// Bring an object to a target.
    Bring(ObjectId, Way, Carry),
    /// Be far from the other agent, whose way to this one it is.
    Escape(Way),
    /// Keep an entity away from a target, or drive it to one.
    Guard(Guard),
    /// Be clear of the other agent's path.
    ClearPath(ClearPath),
}

/// A landmark as a target.
pub(crate) const fn centre(landmark: LandmarkId) -> Target {
    Target::Point(arena::LANDMARKS[landmark.index()])
}

/// A landmark's room from some depth (u) on as a target.
pub(crate) const fn room(landmark: LandmarkId, depth: f32) -> Target {
    Target::Room { room: landmark.room(), depth }
}

/// Unit vectors in so many directions, evenly spaced.
pub(crate) fn directions(count: usize) -> impl Iterator<Item = Vec2> {
    (0..count).map(move |k| {
        let angle = k as f32 * (core::f32::consts::TAU / count as f32);
        Vec2::new(libm::cosf(angle), libm::sinf(angle))
    })
}

/// Length of a pursuer's path to a place (u). Behind a door that is too narrow for it a body is safe, and yet
/// farther away is better.
pub(crate) fn separation(way: &Way, pursuer: Vec2, place: Vec2, impassable: f32) -> f32 {
    let cost = way.distance(pursuer, place);
    if cost >= impassable { cost - impassable } else { cost }
}

/// Of several points around a body of some radius, within the arena, the one farthest from a pursuer by its
/// way.
pub(crate) fn away(way: &Way, pursuer: Vec2, here: Vec2, radius: f32, parameters: &PhaseParameters) -> Vec2 {
    let inset = Vec2::splat(radius);
    let mut best = (f32::NEG_INFINITY, here);
    for direction in directions(parameters.directions) {
        let step = direction * parameters.escape_length;
        let place = (here + step).max(arena::MIN + inset).min(arena::MAX - inset);
        let distance = separation(way, pursuer, place, parameters.impassable);
        if distance > best.0 {
            best = (distance, place);
        }
    }
    best.1
}
