//! The last resort: no centre of mass leaves the arena or crosses a wall, whatever the solver did.

use crate::{
    constants::BOUNDARY_MARGIN,
    key::{KeySet, bit, wall_key},
    world::World,
};
use phase_model::{Segment, Vec2, arena};

/// Distance of a centre of mass from a wall below which a body lies across the wall, in radii of the body. It
/// is kept on its side, and not where it is: it may get off past the wall's end.
const LYING_ACROSS: f32 = 0.5;

impl World<'_> {
    /// Moves a body back if its centre of mass crossed one of the candidate walls or left the arena. Deeply
    /// overlapping bodies that push one another can cause this, since the solver only detects impacts of
    /// bodies that were clear of the wall before.
    pub(crate) fn contain(&mut self, body: usize, candidates: KeySet) {
        let start = self.starts[body].0;
        self.moved(body);
        let motion = &mut self.motions[body];
        if !(motion.centre.is_finite() && motion.velocity.is_finite() && motion.spin.is_finite()) {
            motion.velocity = Vec2::ZERO;
            motion.spin = 0.0;
            motion.centre = start;
        }
        let inside = motion.centre.clamp(arena::MIN + BOUNDARY_MARGIN, arena::MAX - BOUNDARY_MARGIN);
        if inside.x != motion.centre.x {
            motion.velocity.x = 0.0;
        }
        if inside.y != motion.centre.y {
            motion.velocity.y = 0.0;
        }
        motion.centre = inside;
        for (index, wall) in self.model.walls[..self.model.wall_count].iter().enumerate() {
            if candidates & bit(wall_key(index, body)) == 0 {
                continue;
            }
            let before = wall.normal.dot(start - wall.a);
            let after = wall.normal.dot(motion.centre - wall.a);
            // A body that began on the wall itself gets off it, to either side.
            if before * after > 0.0 || before == 0.0 || wall.is_point() {
                continue;
            }
            let path = Segment { a: start, b: motion.centre };
            if path.crosses(Segment { a: wall.a, b: wall.b }) {
                let along = motion.centre - wall.normal * (after - before);
                let lies_across = before.abs() < LYING_ACROSS * self.model.shapes[body].radius;
                motion.centre = if lies_across && self.model.is_free(start, along) { along } else { start };
                let into = motion.velocity.dot(wall.normal);
                motion.velocity -= wall.normal * into;
            }
        }
    }
}
