//! Round obstacles and how much of a straight leg lies in them.

use phase_model::Vec2;

/// A body that stands in the way, as the disc that encloses it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Disc {
    /// Centre (u).
    pub centre: Vec2,
    /// Radius (u).
    pub radius: f32,
}

impl Disc {
    /// Length of the part of the segment from `a` to `b` that lies inside (u).
    pub(crate) fn chord(&self, a: Vec2, b: Vec2) -> f32 {
        let leg = b - a;
        let to_centre = self.centre - a;
        let length_squared = leg.length_squared();
        let cross = leg.perp_dot(to_centre);
        let radius_squared = self.radius * self.radius;
        if length_squared == 0.0 || cross * cross >= radius_squared * length_squared {
            return 0.0;
        }
        let length = length_squared.sqrt();
        let middle = leg.dot(to_centre) / length;
        let half = (radius_squared - cross * cross / length_squared).max(0.0).sqrt();
        ((middle + half).min(length) - (middle - half).max(0.0)).max(0.0)
    }
}
