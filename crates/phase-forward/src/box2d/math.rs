//! Rotations, transforms, and motions within a substep.

use super::PI;
use phase_model::Vec2;

/// A rotation: cosine and sine of its angle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Rotation {
    pub(crate) cos: f32,
    pub(crate) sin: f32,
}

impl Rotation {
    pub(crate) fn new(angle: f32) -> Self {
        let (sin, cos) = sin_cos(angle);
        Self { cos, sin }
    }

    pub(crate) fn turn(self, v: Vec2) -> Vec2 {
        Vec2::new(self.cos * v.x - self.sin * v.y, self.sin * v.x + self.cos * v.y)
    }

    pub(crate) fn turn_back(self, v: Vec2) -> Vec2 {
        Vec2::new(self.cos * v.x + self.sin * v.y, -self.sin * v.x + self.cos * v.y)
    }
}

/// A rotation, then a translation.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Transform {
    pub(crate) place: Vec2,
    pub(crate) rotation: Rotation,
}

impl Transform {
    /// That of a body whose centre of mass, given in its own frame, is at a place.
    pub(crate) fn about(centre: Vec2, angle: f32, local_centre: Vec2) -> Self {
        let rotation = Rotation::new(angle);
        Self { place: centre - rotation.turn(local_centre), rotation }
    }

    pub(crate) fn apply(&self, v: Vec2) -> Vec2 {
        let Rotation { cos, sin } = self.rotation;
        Vec2::new((cos * v.x - sin * v.y) + self.place.x, (sin * v.x + cos * v.y) + self.place.y)
    }

    pub(crate) fn undo(&self, v: Vec2) -> Vec2 {
        self.rotation.turn_back(v - self.place)
    }

    /// Another transform as seen from this one.
    pub(crate) fn relative(&self, other: &Self) -> Self {
        let a = self.rotation;
        let b = other.rotation;
        let rotation = Rotation { cos: a.cos * b.cos + a.sin * b.sin, sin: a.cos * b.sin - a.sin * b.cos };
        Self { place: a.turn_back(other.place - self.place), rotation }
    }
}

/// The motion of a body's centre of mass and angle during a substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sweep {
    pub(crate) local_centre: Vec2,
    pub(crate) from: Vec2,
    pub(crate) to: Vec2,
    pub(crate) from_angle: f32,
    pub(crate) to_angle: f32,
    /// Share of the substep at which it begins.
    pub(crate) start: f32,
}

impl Sweep {
    /// The pose at a share of the motion.
    pub(crate) fn at(&self, share: f32) -> Transform {
        let centre = (1.0 - share) * self.from + share * self.to;
        let angle = (1.0 - share) * self.from_angle + share * self.to_angle;
        Transform::about(centre, angle, self.local_centre)
    }

    /// Lets the motion begin at a later share of the substep.
    pub(crate) fn advance(&mut self, start: f32) {
        let share = (start - self.start) / (1.0 - self.start);
        self.from = (1.0 - share) * self.from + share * self.to;
        self.from_angle = (1.0 - share) * self.from_angle + share * self.to_angle;
        self.start = start;
    }

    /// This motion with angles of less than a turn.
    pub(crate) fn normalised(mut self) -> Self {
        let turn = 2.0 * PI;
        let turns = turn * libm::floorf(self.from_angle / turn);
        self.from_angle -= turns;
        self.to_angle -= turns;
        self
    }
}

/// A vector of length 1, and the length that it had; one that has none stays as it is.
pub(crate) fn normalised(v: Vec2) -> (Vec2, f32) {
    let length = v.length();
    if length < f32::EPSILON {
        return (v, 0.0);
    }
    (v * (1.0 / length), length)
}

/// The vector turned to the right by a right angle.
pub(crate) fn right_of(v: Vec2) -> Vec2 {
    Vec2::new(v.y, -v.x)
}

/// The velocity of a point of a turning body.
pub(crate) fn spun(spin: f32, v: Vec2) -> Vec2 {
    Vec2::new(-spin * v.y, spin * v.x)
}

// The polynomials are those of the Optimized Routines of Arm: Copyright (c) 2018, Arm Limited, MIT licence.

/// Sine and cosine, rounded as the C library of the GNU project rounds them.
fn sin_cos(angle: f32) -> (f32, f32) {
    const QUARTER: f32 = core::f32::consts::FRAC_PI_4;
    const TINY: f32 = 1.0 / 4096.0;
    const LARGE: f32 = 120.0;
    let x = f64::from(angle);
    if angle.abs() < TINY {
        return (angle, 1.0);
    }
    if angle.abs() < QUARTER {
        return (sine(x, x * x), cosine(x * x));
    }
    if angle.abs() >= LARGE || !angle.is_finite() {
        return (libm::sin(x) as f32, libm::cos(x) as f32);
    }
    // Quadrants, rounded to the nearest, in units of 2^-24.
    let quadrants = (x * 10_680_707.430_881_744) as i32;
    let quadrant = quadrants.wrapping_add(0x80_0000) >> 24;
    let rest = x - f64::from(quadrant) * core::f64::consts::FRAC_PI_2;
    let rest = if matches!(quadrant & 3, 1 | 2) { -rest } else { rest };
    let sin = sine(rest, rest * rest);
    let cos = cosine(rest * rest);
    let cos = if quadrant & 2 == 0 { cos } else { -cos };
    if quadrant & 1 == 0 { (sin, cos) } else { (cos, sin) }
}

/// The sine of a small angle, given with its square.
fn sine(x: f64, square: f64) -> f32 {
    let cube = x * square;
    let high = 0.008_332_178_146_138_854 + square * -0.000_195_172_989_813_857_25;
    let low = x + cube * -0.166_666_549_437_010_84;
    (low + cube * square * high) as f32
}

/// The cosine of a small angle, given its square.
fn cosine(square: f64) -> f32 {
    let fourth = square * square;
    let high = -0.001_388_676_379_437_604 + square * 2.439_045_070_356_454_2e-5;
    let low = 1.0 + square * -0.499_999_997_251_082_24;
    (low + fourth * 0.041_666_623_324_344_516 + fourth * square * high) as f32
}

#[cfg(test)]
mod tests {
    use super::sin_cos;

    /// Bits of angles, and of `sinf` and `cosf` of glibc 2.36 where the nearest numbers would be others.
    const GLIBC: [[u32; 3]; 8] = [
        [1_091_221_952, 1_060_066_256, 3_208_284_582],
        [1_105_189_094, 1_049_892_472, 3_212_119_780],
        [3_249_674_330, 1_049_161_402, 3_212_225_716],
        [3_249_826_109, 1_057_491_198, 3_210_272_115],
        [1_095_576_810, 1_048_719_340, 1_064_801_796],
        [3_242_604_400, 1_043_670_355, 1_065_088_619],
        [1_099_026_527, 3_204_308_045, 3_210_629_394],
        [3_198_132_903, 3_197_964_223, 1_064_544_330],
    ];

    #[test]
    fn sines_are_rounded_as_in_glibc() {
        for [angle, sin, cos] in GLIBC {
            let (ours, other) = sin_cos(f32::from_bits(angle));
            assert_eq!([ours.to_bits(), other.to_bits()], [sin, cos], "{}", f32::from_bits(angle));
        }
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
        assert!(sin_cos(f32::NAN).0.is_nan());
    }
}
