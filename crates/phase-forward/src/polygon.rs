//! An agent's outline as a convex polygon in the world.

use crate::body::{BodyMotion, Shape};
use phase_model::Vec2;

/// An agent's corners and side normals in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Polygon {
    pub(crate) corners: [Vec2; 4],
    pub(crate) normals: [Vec2; 4],
}

impl Polygon {
    pub(crate) const NONE: Self = Self { corners: [Vec2::ZERO; 4], normals: [Vec2::ZERO; 4] };

    #[inline]
    pub(crate) fn new(shape: &Shape, motion: &BodyMotion) -> Self {
        // Written out because `map` on arrays does not unroll here.
        let [a, b, c, d] = &shape.corners;
        let [e, f, g, h] = &shape.normals;
        Self {
            corners: [motion.place(*a), motion.place(*b), motion.place(*c), motion.place(*d)],
            normals: [motion.turn(*e), motion.turn(*f), motion.turn(*g), motion.turn(*h)],
        }
    }

    /// Corners of the box around it, without skin (u).
    #[inline]
    pub(crate) fn bounds(&self) -> (Vec2, Vec2) {
        let [a, b, c, d] = self.corners;
        (a.min(b).min(c).min(d), a.max(b).max(c).max(d))
    }

    /// The side with the maximum separation from the other polygon, and that separation. Found by hill
    /// climbing from the side that faces the other's centre of mass most directly, which matters for deep
    /// overlaps.
    #[inline]
    pub(crate) fn max_separation(&self, other: &Self, towards: Vec2) -> (usize, f32) {
        let side = self.incident_side(-towards);
        let gap = self.gap(side, other);
        let previous = (side + 3) % 4;
        let next = (side + 1) % 4;
        let gap_previous = self.gap(previous, other);
        let gap_next = self.gap(next, other);
        let (mut best, step) = if gap_previous > gap && gap_previous > gap_next {
            ((previous, gap_previous), 3)
        } else if gap_next > gap {
            ((next, gap_next), 1)
        } else {
            return (side, gap);
        };
        loop {
            let side = (best.0 + step) % 4;
            let gap = self.gap(side, other);
            if gap <= best.1 {
                return best;
            }
            best = (side, gap);
        }
    }

    /// Distance of the other polygon beyond a side; negative if it reaches behind it.
    #[inline]
    fn gap(&self, side: usize, other: &Self) -> f32 {
        let normal = self.normals[side];
        let nearest = other.corners.iter().fold(f32::MAX, |least, corner| least.min(normal.dot(*corner)));
        nearest - normal.dot(self.corners[side])
    }

    /// The side whose normal is most opposed to a direction.
    #[inline]
    pub(crate) fn incident_side(&self, direction: Vec2) -> usize {
        let mut best = (0, f32::MAX);
        for (side, normal) in self.normals.iter().enumerate() {
            let along = normal.dot(direction);
            if along < best.1 {
                best = (side, along);
            }
        }
        best.0
    }
}
