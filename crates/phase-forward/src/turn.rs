//! Rotation of a unit vector by an angle, with only multiplications and additions for angles as small as
//! those of one substep.

use phase_model::Vec2;

/// Largest angle for which the series below are exact to the last bit or two (rad).
const SMALL: f32 = 0.6;

/// Cosine and sine of an angle, as the unit vector at that angle from +x.
#[inline]
pub(crate) fn cos_sin(angle: f32) -> Vec2 {
    let (sin, cos) = libm::sincosf(angle);
    Vec2::new(cos, sin)
}

/// A unit vector turned counter-clockwise by an angle.
#[inline]
pub(crate) fn turned(vector: Vec2, by: f32) -> Vec2 {
    let turn = if by.abs() <= SMALL {
        let square = by * by;
        let cos = 1.0 - square * (0.5 - square * (1.0 / 24.0 - square * (1.0 / 720.0 - square / 40320.0)));
        let sin = by * (1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0 - square / 5040.0)));
        Vec2::new(cos, sin)
    } else {
        cos_sin(by)
    };
    turn.rotate(vector)
}
