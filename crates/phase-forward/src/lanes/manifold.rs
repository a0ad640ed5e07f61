//! Contact manifolds in each lane; see [`crate::manifold`]. The kind of the reference differs between lanes.

use super::{
    motion::Motions,
    real::{LaneSet, Real, Vector, mask, pick, set, splat},
};
use crate::{
    body::Shape,
    manifold::{Manifold, Reference},
};

/// A contact of two shapes in each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Manifolds {
    /// The lanes in which they touch.
    pub(crate) live: LaneSet,
    /// Those that have two points.
    pub(crate) two: LaneSet,
    /// Those in which the normal leads from the one point of the first shape to the one point of the second.
    pub(crate) points_only: LaneSet,
    /// Those in which the normal belongs to a face of the second shape.
    pub(crate) second: LaneSet,
    pub(crate) normal: Vector,
    pub(crate) anchor: Vector,
    pub(crate) points: [Vector; 2],
    /// Names of the features that made the points.
    pub(crate) names: [Real; 2],
}

/// A body that a contact acts on: a moving one, or the wall.
#[derive(Clone, Copy)]
pub(crate) enum Side<'a> {
    Wall,
    Body(&'a Motions),
}

impl Side<'_> {
    #[inline(always)]
    fn place(self, local: Vector) -> Vector {
        match self {
            Self::Wall => local,
            Self::Body(motion) => motion.place(local),
        }
    }

    #[inline(always)]
    fn turn(self, local: Vector) -> Vector {
        match self {
            Self::Wall => local,
            Self::Body(motion) => motion.turn(local),
        }
    }
}

impl Manifolds {
    pub(crate) const NONE: Self = Self {
        live: 0,
        two: 0,
        points_only: 0,
        second: 0,
        normal: Vector::ZERO,
        anchor: Vector::ZERO,
        points: [Vector::ZERO; 2],
        names: [Real::ZERO; 2],
    };

    /// Sets the contact of one lane.
    pub(crate) fn set(&mut self, lane: usize, manifold: &Manifold) {
        let bit = 1 << lane;
        if manifold.count == 0 {
            return;
        }
        self.live |= bit;
        self.two |= u8::from(manifold.count == 2) << lane;
        self.points_only |= u8::from(manifold.reference == Reference::Points) << lane;
        self.second |= u8::from(manifold.reference == Reference::Second) << lane;
        self.normal.set(lane, manifold.normal);
        self.anchor.set(lane, manifold.anchor);
        for point in 0..2 {
            self.points[point].set(lane, manifold.points[point]);
            set(&mut self.names[point], lane, f32::from(manifold.names[point]));
        }
    }

    /// The normal (from the first shape to the second) and, for one of the points, its position and the distance of the shapes
    /// with their skins there, for bodies at the given poses.
    #[inline]
    pub(crate) fn gap(&self, a: Side<'_>, b: &Motions, skins: Real, point: usize) -> (Vector, Vector, Real) {
        let live = self.live;
        let mut result = (Vector::ZERO, Vector::ZERO, Real::ZERO);
        if live & !(self.points_only | self.second) != 0 {
            let normal = a.turn(self.normal);
            let touching = b.place(self.points[point]);
            result = (normal, touching, (touching - a.place(self.anchor)).dot(normal) - skins);
        }
        if live & self.second != 0 {
            let normal = b.turn(self.normal);
            let touching = a.place(self.points[point]);
            let gap = (touching - b.place(self.anchor)).dot(normal) - skins;
            result = choose(mask(self.second), (-normal, touching, gap), result);
        }
        if live & self.points_only != 0 {
            let (from, to) = (a.place(self.anchor), b.place(self.points[0]));
            let normal = (to - from).normalize_or(Vector::ZERO);
            let at = (from + to) * splat(0.5);
            let gap = (to - from).dot(normal) - skins;
            result = choose(mask(self.points_only), (normal, at, gap), result);
        }
        result
    }

    /// The normal and the midpoints of the overlaps, where impulses act.
    #[inline]
    pub(crate) fn middles(&self, a: Side<'_>, b: &Motions, shapes: [&Shape; 2]) -> (Vector, [Vector; 2]) {
        let live = self.live;
        let (skin_a, skin_b) = (splat(shapes[0].skin), splat(shapes[1].skin));
        let half = splat(0.5);
        let (mut facing, mut middles) = (Vector::ZERO, [Vector::ZERO; 2]);
        if live & !(self.points_only | self.second) != 0 {
            let normal = a.turn(self.normal);
            let plane = a.place(self.anchor);
            facing = normal;
            middles = self.points.map(|point| {
                let clip = b.place(point);
                clip + normal * (half * (skin_a - (clip - plane).dot(normal) - skin_b))
            });
        }
        if live & self.second != 0 {
            let normal = b.turn(self.normal);
            let plane = b.place(self.anchor);
            let chosen = mask(self.second);
            facing = Vector::pick(chosen, -normal, facing);
            for (middle, point) in middles.iter_mut().zip(self.points) {
                let clip = a.place(point);
                let there = clip + normal * (half * (skin_b - (clip - plane).dot(normal) - skin_a));
                middle.put(chosen, there);
            }
        }
        if live & self.points_only != 0 {
            let (from, to) = (a.place(self.anchor), b.place(self.points[0]));
            let normal = (to - from).normalize_or(Vector { x: Real::ONE, y: Real::ZERO });
            let chosen = mask(self.points_only);
            facing = Vector::pick(chosen, normal, facing);
            middles[0].put(chosen, (from + normal * skin_a + to - normal * skin_b) * half);
        }
        (facing, middles)
    }
}

#[inline(always)]
fn choose(mask: Real, a: (Vector, Vector, Real), b: (Vector, Vector, Real)) -> (Vector, Vector, Real) {
    (Vector::pick(mask, a.0, b.0), Vector::pick(mask, a.1, b.1), pick(mask, a.2, b.2))
}
