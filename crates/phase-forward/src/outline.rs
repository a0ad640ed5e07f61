//! The space occupied by bodies at their present poses, computed once for every pose.

use crate::{body::BodyMotion, key::BodyMask, model::Model, polygon::Polygon};
use phase_model::{AGENT_COUNT, Vec2};

/// An axis-aligned box: lower left and upper right corner (u).
pub(crate) type Aabb = (Vec2, Vec2);

/// Outlines of the bodies at the poses at which they were last updated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outlines {
    /// Corners and sides of the agents.
    pub(crate) polygons: [Polygon; AGENT_COUNT],
    /// Boxes around the bodies. Those of agents are without skin.
    pub(crate) boxes: [Aabb; 4],
    /// Bodies that have not moved since.
    current: BodyMask,
}

impl Outlines {
    pub(crate) const NONE: Self =
        Self { polygons: [Polygon::NONE; AGENT_COUNT], boxes: [(Vec2::ZERO, Vec2::ZERO); 4], current: 0 };

    /// Updates the outlines of some bodies.
    #[inline]
    pub(crate) fn update(&mut self, bodies: BodyMask, model: &Model, motions: &[BodyMotion; 5]) {
        let stale = bodies & !self.current;
        if stale == 0 {
            return;
        }
        for (body, motion) in motions.iter().enumerate().take(model.count) {
            if stale & 1 << body == 0 {
                continue;
            }
            let shape = &model.shapes[body];
            self.boxes[body] = if body < AGENT_COUNT {
                let polygon = Polygon::new(shape, motion);
                self.polygons[body] = polygon;
                polygon.bounds()
            } else {
                (motion.centre - shape.radius, motion.centre + shape.radius)
            };
        }
        self.current |= stale;
    }

    /// Records that a body's pose has changed.
    #[inline]
    pub(crate) fn moved(&mut self, body: usize) {
        self.current &= !(1 << body);
    }

    /// Records that the poses of all bodies have changed.
    pub(crate) fn all_moved(&mut self) {
        self.current = 0;
    }
}
