//! Contacts between entities, and the distances between them.

use crate::Track;
use phase_model::{Entity, PhysicsConfig, Segment, State, Vec2, geometry::Outline};

/// Two entities touch when their outlines are no farther apart than this (u). A state of a track is a mean
/// over five substeps, in which bodies that bounce off each other are already apart again.
pub const TOUCH_GAP: f32 = 0.1;

/// Distance between the outlines of two entities, 0 if they overlap (u).
#[must_use]
pub fn gap(physics: &PhysicsConfig, state: &State, a: Entity, b: Entity) -> f32 {
    let outline = |entity: Entity| Outline::of(physics, entity, state.body(entity));
    match (outline(a), outline(b)) {
        (a, b) if a.overlaps(&b) => 0.0,
        (Outline::Trapezoid(a), Outline::Trapezoid(b)) => corner_gap(&a, &b).min(corner_gap(&b, &a)),
        (Outline::Disc { centre, radius }, Outline::Trapezoid(corners))
        | (Outline::Trapezoid(corners), Outline::Disc { centre, radius }) => {
            let distances = edges(&corners).map(|edge| edge.distance(centre));
            distances.fold(f32::INFINITY, f32::min) - radius
        }
        (Outline::Disc { centre: a, radius: r }, Outline::Disc { centre: b, radius: s }) => {
            a.distance(b) - r - s
        }
    }
}

/// Whether two entities touch in a state: physically, or by outlines no farther apart than [`TOUCH_GAP`].
#[must_use]
pub fn touching(physics: &PhysicsConfig, state: &State, a: Entity, b: Entity) -> bool {
    state.touching(a, b) || near(physics, state, a, b)
}

/// Whether the outlines of two entities are no farther apart than [`TOUCH_GAP`]: touching as far as
/// recordings show it.
#[must_use]
pub fn near(physics: &PhysicsConfig, state: &State, a: Entity, b: Entity) -> bool {
    gap(physics, state, a, b) <= TOUCH_GAP
}

/// The steps (0 for the initial state) at which two entities touch, in order.
#[must_use]
pub fn steps_touching(track: &Track, a: Entity, b: Entity) -> Vec<usize> {
    let touch = |state: &State| touching(&track.physics, state, a, b);
    (0..track.states.len()).filter(|&t| touch(&track.states[t])).collect()
}

/// The nearest points of two convex polygons that are apart include a corner of one of them.
fn corner_gap(corners: &[Vec2; 4], polygon: &[Vec2; 4]) -> f32 {
    let distances = corners.iter().flat_map(|&corner| edges(polygon).map(move |edge| edge.distance(corner)));
    distances.fold(f32::INFINITY, f32::min)
}

fn edges(polygon: &[Vec2; 4]) -> impl Iterator<Item = Segment> {
    (0..4).map(|k| Segment { a: polygon[k], b: polygon[(k + 1) % 4] })
}
