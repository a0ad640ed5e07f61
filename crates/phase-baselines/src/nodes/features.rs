//! The features of one node at one step.

use phase_model::{
    AGENT_COUNT, Body, Segment, Vec2,
    arena::{self, LANDMARKS},
};

/// Features of a node: type (4, one-hot), colour, that is its index within its type (4, one-hot; walls have
/// none), half its length, position (2), direction it faces (2), velocity (2).
pub const FEATURES: usize = 15;

/// Half the arena's side (u): the scale of lengths and positions, so that they lie between −1 and 1.
pub(crate) const LENGTH: f32 = arena::SIDE / 2.0;
/// The scale of velocities (u/s); most are below it.
pub(crate) const SPEED: f32 = 10.0;

/// An agent or object by its index, with its radius (u).
pub(super) fn body(index: usize, radius: f32, body: &Body) -> [f32; FEATURES] {
    let (kind, number) = if index < AGENT_COUNT { (0, index) } else { (1, index - AGENT_COUNT) };
    node(kind, Some(number), radius, body.position, body.forward(), body.velocity)
}

/// A landmark.
pub(super) fn landmark(number: usize) -> [f32; FEATURES] {
    node(2, Some(number), arena::LANDMARK_HALF_SIDE, LANDMARKS[number], Vec2::ZERO, Vec2::ZERO)
}

/// An inner wall, at its middle and facing along itself.
pub(super) fn wall(wall: &Segment) -> [f32; FEATURES] {
    let along = wall.b - wall.a;
    let middle = (wall.a + wall.b) / 2.0;
    let half = along.length() / 2.0;
    node(3, None, half, middle, along.normalize_or_zero(), Vec2::ZERO)
}

fn node(
    kind: usize,
    number: Option<usize>,
    half_length: f32,
    position: Vec2,
    facing: Vec2,
    velocity: Vec2,
) -> [f32; FEATURES] {
    let mut features = [0.0; FEATURES];
    features[kind] = 1.0;
    if let Some(number) = number {
        features[4 + number] = 1.0;
    }
    let place = (position - arena::CENTRE) / LENGTH;
    let velocity = velocity / SPEED;
    let rest = [half_length / LENGTH, place.x, place.y, facing.x, facing.y, velocity.x, velocity.y];
    features[8..].copy_from_slice(&rest);
    features
}
