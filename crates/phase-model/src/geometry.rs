//! Shapes and the tests between them: trapezoids, discs and segments.

use crate::{Body, Entity, PhysicsConfig, Vec2, arena};
use serde::{Deserialize, Serialize};

/// A straight piece of wall, or of an opening, from `a` to `b` (u).
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Segment {
    /// One end.
    pub a: Vec2,
    /// The other end.
    pub b: Vec2,
}

impl Segment {
    /// The point of the segment nearest to a point.
    #[must_use]
    pub fn nearest(self, point: Vec2) -> Vec2 {
        let along = self.b - self.a;
        let length_squared = along.length_squared();
        if length_squared == 0.0 {
            return self.a;
        }
        self.a + along * ((point - self.a).dot(along) / length_squared).clamp(0.0, 1.0)
    }

    /// Distance from a point to the segment (u).
    #[must_use]
    pub fn distance(self, point: Vec2) -> f32 {
        point.distance(self.nearest(point))
    }

    /// Length (u).
    #[must_use]
    pub fn length(self) -> f32 {
        self.a.distance(self.b)
    }

    /// The point half-way (u).
    #[must_use]
    pub fn middle(self) -> Vec2 {
        (self.a + self.b) * 0.5
    }

    /// Whether two segments have a point in common; touching counts, parallel overlap does not.
    #[must_use]
    pub fn crosses(self, other: Self) -> bool {
        let d1 = self.b - self.a;
        let d2 = other.b - other.a;
        let denominator = d1.perp_dot(d2);
        if denominator == 0.0 {
            return false;
        }
        let between = other.a - self.a;
        let t = between.perp_dot(d2) / denominator;
        let u = between.perp_dot(d1) / denominator;
        (0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&u)
    }
}

/// Unit vector of the heading at an angle, (−sin θ, cos θ).
#[must_use]
pub fn forward(angle: f32) -> Vec2 {
    let (sin, cos) = libm::sincosf(angle);
    Vec2::new(-sin, cos)
}

/// An agent's four corners in its own frame (x right, y forward), counter-clockwise from the rear left: base
/// 3R wide at the rear, top R wide at the front, 2R high.
#[must_use]
pub const fn trapezoid(radius: f32) -> [Vec2; 4] {
    [
        Vec2::new(-1.5 * radius, -radius),
        Vec2::new(1.5 * radius, -radius),
        Vec2::new(0.5 * radius, radius),
        Vec2::new(-0.5 * radius, radius),
    ]
}

/// Distance of an agent's rear corners, its farthest points, from its origin: √(1.5² + 1²), rounded up (R).
pub const FARTHEST_CORNER: f32 = 1.803;

/// The outline of one entity in the world.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Outline {
    /// An agent's corners, counter-clockwise (u).
    Trapezoid([Vec2; 4]),
    /// An object (u).
    Disc {
        /// Centre.
        centre: Vec2,
        /// Radius.
        radius: f32,
    },
}

impl Outline {
    /// The outline of an entity of a scene whose body is the given one.
    #[must_use]
    pub fn of(physics: &PhysicsConfig, entity: Entity, body: &Body) -> Self {
        let radius = physics.radius(entity);
        match entity {
            Entity::Agent(_) => {
                let rotation = Vec2::from_angle(body.angle);
                Self::Trapezoid(trapezoid(radius).map(|corner| body.position + rotation.rotate(corner)))
            }
            Entity::Object(_) => Self::Disc { centre: body.position, radius },
        }
    }

    /// Bounding box of the outline: lower left and upper right corner (u).
    #[must_use]
    pub fn bounds(&self) -> (Vec2, Vec2) {
        match *self {
            Self::Trapezoid([a, b, c, d]) => (a.min(b).min(c).min(d), a.max(b).max(c).max(d)),
            Self::Disc { centre, radius } => (centre - Vec2::splat(radius), centre + Vec2::splat(radius)),
        }
    }

    /// Whether the outline lies entirely inside the arena.
    #[must_use]
    pub fn inside_arena(&self) -> bool {
        let (min, max) = self.bounds();
        arena::contains(min) && arena::contains(max)
    }

    /// Whether two outlines have inner points in common; touching does not count.
    #[must_use]
    pub fn overlaps(&self, other: &Self) -> bool {
        match (*self, *other) {
            (Self::Disc { centre: a, radius: r }, Self::Disc { centre: b, radius: s }) => {
                a.distance_squared(b) < (r + s) * (r + s)
            }
            (Self::Disc { centre, radius }, Self::Trapezoid(corners))
            | (Self::Trapezoid(corners), Self::Disc { centre, radius }) => {
                contains(&corners, centre) || edges(&corners).any(|edge| edge.distance(centre) < radius)
            }
            (Self::Trapezoid(a), Self::Trapezoid(b)) => !separated(&a, &b) && !separated(&b, &a),
        }
    }

    /// Whether a wall passes through the inside of the outline; touching does not count.
    #[must_use]
    pub fn overlaps_wall(&self, wall: Segment) -> bool {
        match *self {
            Self::Disc { centre, radius } => wall.distance(centre) < radius,
            Self::Trapezoid(corners) => {
                let normal = (wall.b - wall.a).perp();
                let line = wall.a.dot(normal);
                let sides = corners.map(|corner| corner.dot(normal) - line);
                let straddles = sides.iter().any(|&side| side > 0.0) && sides.iter().any(|&side| side < 0.0);
                straddles
                    && !edges(&corners).any(|edge| {
                        let outward = -(edge.b - edge.a).perp();
                        let limit = edge.a.dot(outward);
                        wall.a.dot(outward) >= limit && wall.b.dot(outward) >= limit
                    })
            }
        }
    }
}

/// The edges of a polygon, in order.
pub(crate) fn edges(corners: &[Vec2; 4]) -> impl Iterator<Item = Segment> {
    (0..4).map(|k| Segment { a: corners[k], b: corners[(k + 1) % 4] })
}

/// Whether a point lies strictly inside a convex counter-clockwise polygon.
pub(crate) fn contains(corners: &[Vec2; 4], point: Vec2) -> bool {
    edges(corners).all(|edge| (edge.b - edge.a).perp_dot(point - edge.a) > 0.0)
}

/// Whether one of the edges of `a` has all of `b` outside (separating axis theorem).
fn separated(a: &[Vec2; 4], b: &[Vec2; 4]) -> bool {
    edges(a).any(|edge| {
        let along = edge.b - edge.a;
        b.iter().all(|&corner| along.perp_dot(corner - edge.a) <= 0.0)
    })
}
