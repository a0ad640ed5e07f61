//! Shapes and the masses that follow from them.

use super::{
    PI, SKIN, WALLS_AT,
    math::{Transform, normalised, right_of},
};
use phase_model::{Segment, Vec2};

/// The outline of a shape, in its body's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Outline {
    /// A disc about the body's origin.
    Disc,
    /// An agent: corners counter-clockwise from the right end of its base, the outward normals of the sides
    /// that begin there, and the centre of its area.
    Polygon { corners: [Vec2; 4], normals: [Vec2; 4], centre: Vec2 },
    /// A straight piece of wall, which may be a point.
    Edge(Vec2, Vec2),
}

/// A shape with the mass of its body; walls have none.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    pub(crate) outline: Outline,
    /// Radius of a disc, or thickness of the skin (u).
    pub(crate) radius: f32,
    pub(crate) inverse_mass: f32,
    pub(crate) inverse_inertia: f32,
    /// Centre of mass in the body's frame.
    pub(crate) local_centre: Vec2,
    /// Radius of the circle about the centre of mass that encloses it, skin included (u).
    pub(crate) reach: f32,
}

impl Shape {
    /// An agent of a size (u).
    pub(crate) fn agent(size: f64) -> Self {
        let corner = |x: f64, y: f64| Vec2::new((x * size) as f32, (y * size) as f32);
        let corners = [corner(1.5, -1.0), corner(0.5, 1.0), corner(-0.5, 1.0), corner(-1.5, -1.0)];
        let normals = core::array::from_fn(|k| normalised(right_of(corners[(k + 1) % 4] - corners[k])).0);
        let outline = Outline::Polygon { corners, normals, centre: centroid(&corners) };
        let (mass, centre, inertia) = polygon_mass(&corners);
        let inverse_mass = 1.0 / mass;
        let local_centre = mass * centre * inverse_mass;
        let inertia = inertia - mass * local_centre.dot(local_centre);
        let reach = corners.iter().fold(0.0_f32, |most, it| most.max(it.distance(local_centre))) + SKIN;
        Self { outline, radius: SKIN, inverse_mass, inverse_inertia: 1.0 / inertia, local_centre, reach }
    }

    /// An object of a radius (u).
    pub(crate) fn object(radius: f64) -> Self {
        let radius = radius as f32;
        let mass = PI * radius * radius;
        let inertia = mass * (0.5 * radius * radius);
        Self {
            outline: Outline::Disc,
            radius,
            inverse_mass: 1.0 / mass,
            inverse_inertia: 1.0 / inertia,
            local_centre: Vec2::ZERO,
            reach: radius,
        }
    }

    /// A piece of wall.
    pub(crate) fn wall(segment: Segment) -> Self {
        Self {
            outline: Outline::Edge(segment.a - WALLS_AT, segment.b - WALLS_AT),
            radius: SKIN,
            inverse_mass: 0.0,
            inverse_inertia: 0.0,
            local_centre: Vec2::ZERO,
            reach: 0.0,
        }
    }

    /// The box around it in a pose, skin included (u).
    pub(crate) fn bounds(&self, pose: &Transform) -> (Vec2, Vec2) {
        let (min, max) = match &self.outline {
            Outline::Disc => (pose.place, pose.place),
            Outline::Polygon { corners, .. } => {
                let [a, b, c, d] = corners.map(|corner| pose.apply(corner));
                (a.min(b).min(c).min(d), a.max(b).max(c).max(d))
            }
            Outline::Edge(a, b) => {
                let a = pose.apply(*a);
                let b = pose.apply(*b);
                (a.min(b), a.max(b))
            }
        };
        (min - self.radius, max + self.radius)
    }

    /// Its corners; the centre of a disc.
    pub(crate) fn corners(&self) -> ([Vec2; 4], usize) {
        match self.outline {
            Outline::Disc => ([Vec2::ZERO; 4], 1),
            Outline::Polygon { corners, .. } => (corners, 4),
            Outline::Edge(a, b) => ([a, b, b, b], 2),
        }
    }
}

const THIRD: f32 = 1.0 / 3.0;

fn centroid(corners: &[Vec2; 4]) -> Vec2 {
    let mut centre = Vec2::ZERO;
    let mut area = 0.0;
    for k in 0..4 {
        let a = corners[k];
        let b = corners[(k + 1) % 4];
        let triangle = 0.5 * a.perp_dot(b);
        area += triangle;
        centre += triangle * THIRD * (a + b);
    }
    centre * (1.0 / area)
}

/// Mass, centre of mass, and moment of inertia about the origin, of density 1.
fn polygon_mass(corners: &[Vec2; 4]) -> (f32, Vec2, f32) {
    let middle = corners.iter().fold(Vec2::ZERO, |sum, &corner| sum + corner) * (1.0 / 4.0);
    let mut centre = Vec2::ZERO;
    let mut area = 0.0;
    let mut inertia = 0.0;
    for k in 0..4 {
        let a = corners[k] - middle;
        let b = corners[(k + 1) % 4] - middle;
        let double = a.perp_dot(b);
        let triangle = 0.5 * double;
        area += triangle;
        centre += triangle * THIRD * (a + b);
        let x = a.x * a.x + b.x * a.x + b.x * b.x;
        let y = a.y * a.y + b.y * a.y + b.y * b.y;
        inertia += (0.25 * THIRD * double) * (x + y);
    }
    centre *= 1.0 / area;
    let of_mass = centre + middle;
    (area, of_mass, inertia + area * (of_mass.dot(of_mass) - centre.dot(centre)))
}
