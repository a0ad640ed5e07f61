//! Paths and walls.

use phase_model::{Segment, Vec2};

/// Whether a path crosses a wall permanently: from clearly on one side to clearly on the other.
pub(crate) fn passes(from: Vec2, to: Vec2, wall: Segment) -> bool {
    let normal = (wall.b - wall.a).perp().normalize();
    let sides = [from, to].map(|point| normal.dot(point - wall.a));
    sides[0] * sides[1] < 0.0
        && sides.iter().all(|side| side.abs() > 1e-3)
        && Segment { a: from, b: to }.crosses(wall)
}
