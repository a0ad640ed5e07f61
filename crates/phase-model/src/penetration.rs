//! Penetration depths of outlines in each other, in walls and in the arena's boundary.

use crate::{
    Segment, Vec2, arena,
    geometry::{Outline, contains, edges},
};

impl Outline {
    /// Minimum distance by which one of two outlines has to be moved to end their overlap (u); `None` if they
    /// do not overlap.
    #[must_use]
    pub fn depth(&self, other: &Self) -> Option<f32> {
        let depth = match (*self, *other) {
            (Self::Disc { centre: a, radius: r }, Self::Disc { centre: b, radius: s }) => {
                r + s - a.distance(b)
            }
            (Self::Disc { centre, radius }, Self::Trapezoid(corners))
            | (Self::Trapezoid(corners), Self::Disc { centre, radius }) => {
                let gap = edges(&corners).map(|edge| edge.distance(centre)).fold(f32::INFINITY, f32::min);
                if contains(&corners, centre) { radius + gap } else { radius - gap }
            }
            (Self::Trapezoid(a), Self::Trapezoid(b)) => convex_depth(&a, &b),
        };
        (depth > 0.0).then_some(depth)
    }

    /// Minimum distance by which the outline has to be moved to lie beside a wall (u); `None` if the wall
    /// does not pass through it.
    #[must_use]
    pub fn depth_in_wall(&self, wall: Segment) -> Option<f32> {
        let depth = match *self {
            Self::Disc { centre, radius } => radius - wall.distance(centre),
            Self::Trapezoid(corners) => convex_depth(&corners, &[wall.a, wall.b]),
        };
        (depth > 0.0).then_some(depth)
    }

    /// Distance by which the outline extends beyond the arena's boundary (u); `None` if it does not.
    #[must_use]
    pub fn depth_in_boundary(&self) -> Option<f32> {
        let (min, max) = self.bounds();
        let depth = (arena::MIN - min).max_element().max((max - arena::MAX).max_element());
        (depth > 0.0).then_some(depth)
    }
}

/// The minimum overlap of two convex shapes along the normals of their edges (separating axis theorem); zero
/// or negative if they are apart. The corners of a shape are in cyclic order; two corners are a segment.
fn convex_depth(a: &[Vec2], b: &[Vec2]) -> f32 {
    let normals = |corners: &[Vec2]| -> Vec<Vec2> {
        let ends = corners.iter().zip(corners.iter().cycle().skip(1));
        ends.map(|(from, to)| (*to - *from).perp().normalize_or_zero()).collect()
    };
    let extent = |corners: &[Vec2], normal: Vec2| {
        corners
            .iter()
            .map(|corner| corner.dot(normal))
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(min, max), x| (min.min(x), max.max(x)))
    };
    let overlap = |normal: Vec2| {
        let (a_min, a_max) = extent(a, normal);
        let (b_min, b_max) = extent(b, normal);
        (a_max - b_min).min(b_max - a_min)
    };
    normals(a).into_iter().chain(normals(b)).map(overlap).fold(f32::INFINITY, f32::min)
}
