//! Contact manifolds of two shapes: one normal and up to two points, in the frames of the two bodies.

use crate::body::BodyMotion;
use phase_model::Vec2;

/// The shape that the normal belongs to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Reference {
    /// Neither: the normal leads from the one point of the first shape to the one point of the second, and in
    /// the direction [`APART`] where the two are the same.
    Points,
    /// A face of the first shape.
    First,
    /// A face of the second shape.
    Second,
}

/// The normal of two points at one place, so that there always is one, and the same for the same state. The
/// axes of the arena are those of its walls: along a wall, a body at its end gets off the end or onto the
/// wall's side, and from there off the wall.
const APART: Vec2 = Vec2::X;

/// A contact of two shapes, in local frames so that it stays valid while the position solver moves them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Manifold {
    pub(crate) reference: Reference,
    /// Number of points, 0 to 2.
    pub(crate) count: usize,
    /// Normal of the reference face, in the frame of its body.
    pub(crate) normal: Vec2,
    /// A point of the reference face (or the first shape's point), in the frame of its body.
    pub(crate) anchor: Vec2,
    /// The touching points of the other shape, in the frame of its body.
    pub(crate) points: [Vec2; 2],
    /// Names of the features that made the points, by which impulses are matched between substeps.
    pub(crate) names: [u16; 2],
}

impl Manifold {
    pub(crate) const NONE: Self = Self {
        reference: Reference::Points,
        count: 0,
        normal: Vec2::ZERO,
        anchor: Vec2::ZERO,
        points: [Vec2::ZERO; 2],
        names: [0; 2],
    };

    /// A contact at one point.
    pub(crate) fn single(reference: Reference, normal: Vec2, anchor: Vec2, point: Vec2) -> Self {
        Self { reference, count: 1, normal, anchor, points: [point; 2], names: [0; 2] }
    }

    /// The normal (from the first shape to the second) and, for one of the points, its position and the
    /// distance of the shapes with their skins there, for bodies at the given poses.
    #[inline]
    pub(crate) fn gap(&self, a: &BodyMotion, b: &BodyMotion, skins: f32, point: usize) -> (Vec2, Vec2, f32) {
        match self.reference {
            Reference::Points => {
                let from = a.place(self.anchor);
                let to = b.place(self.points[0]);
                let normal = direction(from, to);
                (normal, (from + to) * 0.5, (to - from).dot(normal) - skins)
            }
            Reference::First => {
                let normal = a.turn(self.normal);
                let touching = b.place(self.points[point]);
                (normal, touching, (touching - a.place(self.anchor)).dot(normal) - skins)
            }
            Reference::Second => {
                let normal = b.turn(self.normal);
                let touching = a.place(self.points[point]);
                (-normal, touching, (touching - b.place(self.anchor)).dot(normal) - skins)
            }
        }
    }

    /// [`Manifold::gap`] where the first shape is a wall.
    #[inline]
    pub(crate) fn gap_to_wall(&self, body: &BodyMotion, skins: f32, point: usize) -> (Vec2, Vec2, f32) {
        match self.reference {
            Reference::Points => {
                let to = body.place(self.points[0]);
                let normal = direction(self.anchor, to);
                (normal, (self.anchor + to) * 0.5, (to - self.anchor).dot(normal) - skins)
            }
            Reference::First => {
                let touching = body.place(self.points[point]);
                (self.normal, touching, (touching - self.anchor).dot(self.normal) - skins)
            }
            Reference::Second => {
                let normal = body.turn(self.normal);
                let touching = self.points[point];
                (-normal, touching, (touching - body.place(self.anchor)).dot(normal) - skins)
            }
        }
    }

    /// The normal and the midpoints of the overlaps, where impulses act.
    #[inline]
    pub(crate) fn middles(
        &self,
        a: &BodyMotion,
        b: &BodyMotion,
        skin_a: f32,
        skin_b: f32,
    ) -> (Vec2, [Vec2; 2]) {
        let mut middles = [Vec2::ZERO; 2];
        match self.reference {
            Reference::Points => {
                let from = a.place(self.anchor);
                let to = b.place(self.points[0]);
                let normal = direction(from, to);
                middles[0] = (from + normal * skin_a + to - normal * skin_b) * 0.5;
                (normal, middles)
            }
            Reference::First => {
                let normal = a.turn(self.normal);
                let plane = a.place(self.anchor);
                for (middle, point) in middles.iter_mut().zip(self.points).take(self.count) {
                    let clip = b.place(point);
                    *middle = clip + normal * (0.5 * (skin_a - (clip - plane).dot(normal) - skin_b));
                }
                (normal, middles)
            }
            Reference::Second => {
                let normal = b.turn(self.normal);
                let plane = b.place(self.anchor);
                for (middle, point) in middles.iter_mut().zip(self.points).take(self.count) {
                    let clip = a.place(point);
                    *middle = clip + normal * (0.5 * (skin_b - (clip - plane).dot(normal) - skin_a));
                }
                (-normal, middles)
            }
        }
    }
}

/// The normal from one point to another.
#[inline]
fn direction(from: Vec2, to: Vec2) -> Vec2 {
    (to - from).try_normalize().unwrap_or(APART)
}
