//! What bodies occupy where they are now, worked out once for every pose.

use crate::{manifold::Polygon, substep::BodySet, world::World};
use phase_model::{AGENT_COUNT, Vec2};

/// A box with sides along the axes: lower left and upper right corner (u).
pub(crate) type Aabb = (Vec2, Vec2);

/// Outlines of the bodies at the poses at which they were last looked at.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outlines {
    /// Corners and sides of the agents.
    pub(crate) polygons: [Polygon; AGENT_COUNT],
    /// Boxes around the bodies. Those of agents are without skin.
    pub(crate) boxes: [Aabb; 4],
    /// Bodies that have not moved since.
    current: BodySet,
}

impl Outlines {
    pub(crate) const NONE: Self =
        Self { polygons: [Polygon::NONE; AGENT_COUNT], boxes: [(Vec2::ZERO, Vec2::ZERO); 4], current: 0 };
}

impl World<'_> {
    /// Brings the outlines of some bodies up to date.
    #[inline]
    pub(crate) fn outline(&mut self, bodies: BodySet) {
        let stale = bodies & !self.outlines.current;
        if stale == 0 {
            return;
        }
        for body in 0..self.forward.count {
            if stale & 1 << body == 0 {
                continue;
            }
            let (shape, motion) = (&self.forward.shapes[body], &self.motions[body]);
            self.outlines.boxes[body] = if body < AGENT_COUNT {
                let polygon = Polygon::new(shape, motion);
                self.outlines.polygons[body] = polygon;
                polygon.bounds()
            } else {
                (motion.centre - shape.radius, motion.centre + shape.radius)
            };
        }
        self.outlines.current |= stale;
    }

    /// Notes that a body has another pose now.
    #[inline]
    pub(crate) fn moved(&mut self, body: usize) {
        self.outlines.current &= !(1 << body);
    }

    /// The same for all bodies.
    pub(crate) fn all_moved(&mut self) {
        self.outlines.current = 0;
    }
}
