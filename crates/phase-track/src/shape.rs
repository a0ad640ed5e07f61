//! Outlines of bodies, and what they look like.

use crate::picture::{Rgb, mix};
use phase_model::Vec2;

/// Form of a body.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Form {
    /// An agent: a trapezoid 3 R wide at its base and R at its head, 2 R high.
    Trapezoid,
    /// An object: a disc of radius R.
    Disc,
}

/// Place and direction of a body. An agent at angle 0 faces up.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Pose {
    /// Place of the body's origin (u).
    pub position: Vec2,
    /// Angle, counter-clockwise (rad); 0 for discs.
    pub angle: f32,
}

/// The look of bodies in a video, beside their colours.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Look {
    /// Width of a dark outline inside the body's edge (u); 0 without.
    pub(crate) outline: f32,
    /// Width of a dark outline outside of it (u); 0 without.
    pub(crate) margin: f32,
    /// Whether agents have eyes.
    pub(crate) eyes: bool,
    /// Whether light is dark: the picture is the negative of one with light lines on a dark ground.
    pub(crate) negative: bool,
}

/// Brightness of outlines.
const OUTLINE: f32 = 40.0;

/// Place of the right eye in the frame of an agent of radius 1, and the radius of its rim.
const EYE: Vec2 = Vec2::new(0.5, 0.5);
const EYE_RADIUS: f32 = 0.335;
/// Place and radius of its pupil, which lies at the front.
const PUPIL: Vec2 = Vec2::new(0.5, 0.7);
const PUPIL_RADIUS: f32 = 0.224;
/// Distance from the eye's middle beyond which nothing of it is drawn.
const EYE_REACH: f32 = 0.43;

/// A body as it is drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Appearance {
    pub(crate) form: Form,
    pub(crate) radius: f32,
    pub(crate) colour: Rgb,
    pub(crate) look: Look,
}

impl Appearance {
    /// Greatest distance of the outline from the origin (u).
    pub(crate) fn reach(&self) -> f32 {
        self.radius * if self.form == Form::Trapezoid { 1.81 } else { 1.0 } + 2.0 * self.look.margin
    }

    /// Distance from the outline (u), negative inside, of a point in the body's frame.
    fn depth(&self, point: Vec2) -> f32 {
        match self.form {
            Form::Disc => point.length() - self.radius,
            Form::Trapezoid => {
                // A flank goes from (1.5 R, −R) to (0.5 R, R).
                let flank = (2.0 * point.x.abs() + point.y - 2.0 * self.radius) / 5.0_f32.sqrt();
                flank.max(point.y.abs() - self.radius)
            }
        }
    }

    /// Share of a pixel that the body covers, for an edge `soft` wide (u), at a point in the body's frame.
    pub(crate) fn cover(&self, point: Vec2, soft: f32) -> f32 {
        (0.5 - self.depth(point) / soft).clamp(0.0, 1.0)
    }

    /// Whether all points within `near` (u) of one in the body's frame surely look as it does: they lie
    /// outside of the body, or in its plain colour.
    pub(crate) fn is_plain(&self, point: Vec2, soft: f32, near: f32) -> bool {
        let depth = self.depth(point) - self.look.margin;
        // Edges, and what rounding may add to them.
        let edge = 0.5 * soft + near + 1e-4;
        if depth > edge + if self.look.eyes { 0.1 * self.radius } else { 0.0 } {
            return true;
        }
        if depth + self.look.outline + self.look.margin > -edge {
            return false;
        }
        if !self.look.eyes || self.form != Form::Trapezoid {
            return true;
        }
        Vec2::new(point.x.abs(), point.y).distance(EYE * self.radius) > EYE_REACH * self.radius + edge
    }

    /// The colour at a point in the body's frame over what lies under it.
    pub(crate) fn over(&self, under: Rgb, point: Vec2, soft: f32) -> Rgb {
        let depth = self.depth(point) - self.look.margin;
        let outline = self.look.outline + self.look.margin;
        let share = |distance: f32| (0.5 - distance / soft).clamp(0.0, 1.0);
        // Eyes stand out a little.
        if depth > 0.5 * soft + if self.look.eyes { 0.1 * self.radius } else { 0.0 } {
            return under;
        }
        let as_seen = |level: f32| [if self.look.negative { 255.0 - level } else { level }; 3];
        let mut inside = self.colour;
        if outline > 0.0 {
            inside = mix(as_seen(OUTLINE), inside, share(depth + outline));
        }
        let mut colour = mix(under, inside, share(depth));
        if self.look.eyes && self.form == Form::Trapezoid {
            let unit = Vec2::new(point.x.abs(), point.y) / self.radius;
            let soft = soft / self.radius;
            if unit.distance_squared(EYE) > (EYE_REACH + 0.5 * soft) * (EYE_REACH + 0.5 * soft) {
                return colour;
            }
            let disc =
                |centre: Vec2, radius: f32| (0.5 - (unit.distance(centre) - radius) / soft).clamp(0.0, 1.0);
            colour = mix(colour, as_seen(0.0), disc(EYE, EYE_RADIUS));
            colour = mix(colour, as_seen(255.0), disc(EYE, 0.291));
            colour = mix(colour, as_seen(0.0), disc(PUPIL, PUPIL_RADIUS));
        }
        colour
    }
}
