//! Substeps of a body that walls may be near, but that nothing touches.

use crate::{
    impact::Ends,
    key::descending,
    manifold::Polygon,
    tuning::{SKIN, SLOP},
    world::World,
};
use phase_model::{AGENT_COUNT, Vec2};

impl World<'_> {
    /// Moves a body that no other body is near on for one substep, provided that it stays clear of all walls
    /// it can reach, so that the ground alone acts on it. Otherwise leaves it as it is and returns false.
    /// Keeps agents' outlines for the next substep.
    pub(crate) fn glide(&mut self, body: usize, outlines: &mut [Option<Polygon>; AGENT_COUNT]) -> bool {
        let shape = &self.forward.shapes[body];
        let before = self.motions[body];
        let mut after = before;
        if body < AGENT_COUNT {
            after.act(shape, self.actions[body]);
        }
        let rests = after.velocity == Vec2::ZERO && after.spin == 0.0;
        if rests && self.at_ease & 1 << body != 0 {
            return true;
        }
        after.slide(shape);
        if self.walls[body] != 0 {
            // Within their skins walls may touch a moving body; one at rest they leave alone unless it
            // overlaps them more than contacts do on purpose.
            let slack = if rests { SLOP + 0.1 * SLOP } else { 0.0 };
            let polygons = (body < AGENT_COUNT).then(|| {
                let first = outlines[body].unwrap_or_else(|| Polygon::new(shape, &before));
                let last = if rests { first } else { Polygon::new(shape, &after) };
                outlines[body] = Some(last);
                [first, last]
            });
            let ends =
                Ends { centres: [before.centre, after.centre], polygons, clear: shape.skin + SKIN - slack };
            if !descending(self.walls[body]).all(|key| ends.clear_of(&self.forward.walls[key / 4])) {
                return false;
            }
        }
        self.motions[body] = after;
        self.at_ease = self.at_ease & !(1 << body) | u8::from(rests) << body;
        true
    }
}
