//! Numbers, vectors and sets with one entry for each of eight worlds.
//!
//! Every operation has the rounding of its scalar counterpart, in the same order: what is computed for a lane does not depend
//! on the other lanes, nor on the vector instructions of the processor.

use core::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};
use phase_model::Vec2;
use wide::f32x8;

/// Number of worlds that are stepped together, one in each lane of a vector.
pub const LANES: usize = 8;

/// A set of lanes, one bit each.
pub(crate) type LaneSet = u8;

/// One number for each lane; or a mask, whose bits are all set in the lanes that it contains.
pub(crate) type Real = f32x8;

/// The masks of all sets of lanes.
static MASKS: [[f32; LANES]; 256] = masks();

const fn masks() -> [[f32; LANES]; 256] {
    let mut masks = [[0.0; LANES]; 256];
    let mut set = 0;
    while set < 256 {
        let mut lane = 0;
        while lane < LANES {
            if set & 1 << lane != 0 {
                masks[set][lane] = f32::from_bits(u32::MAX);
            }
            lane += 1;
        }
        set += 1;
    }
    masks
}

/// The mask of a set of lanes.
#[inline(always)]
pub(crate) fn mask(set: LaneSet) -> Real {
    Real::new(MASKS[usize::from(set)])
}

/// The lanes that a mask contains.
#[inline(always)]
pub(crate) fn lanes(mask: Real) -> LaneSet {
    mask.to_bitmask() as LaneSet
}

/// The same number in every lane.
#[inline(always)]
pub(crate) fn splat(number: f32) -> Real {
    Real::splat(number)
}

/// The lanes of a set, in order.
pub(crate) fn each(mut set: LaneSet) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        if set == 0 {
            return None;
        }
        let lane = set.trailing_zeros() as usize;
        set &= set - 1;
        Some(lane)
    })
}

#[inline(always)]
pub(crate) fn less(a: Real, b: Real) -> Real {
    a.simd_lt(b)
}

#[inline(always)]
pub(crate) fn at_most(a: Real, b: Real) -> Real {
    a.simd_le(b)
}

#[inline(always)]
pub(crate) fn greater(a: Real, b: Real) -> Real {
    a.simd_gt(b)
}

#[inline(always)]
pub(crate) fn at_least(a: Real, b: Real) -> Real {
    a.simd_ge(b)
}

#[inline(always)]
pub(crate) fn equal(a: Real, b: Real) -> Real {
    a.simd_eq(b)
}

#[inline(always)]
pub(crate) fn differ(a: Real, b: Real) -> Real {
    a.simd_ne(b)
}

/// `a` where the mask is set, `b` elsewhere.
#[inline(always)]
pub(crate) fn pick(mask: Real, a: Real, b: Real) -> Real {
    mask.select(a, b)
}

/// `if a < b { a } else { b }`.
#[inline(always)]
pub(crate) fn smaller(a: Real, b: Real) -> Real {
    a.fast_min(b)
}

/// `if a > b { a } else { b }`.
#[inline(always)]
pub(crate) fn larger(a: Real, b: Real) -> Real {
    a.fast_max(b)
}

/// Stores a number in the lanes of a mask.
#[inline(always)]
pub(crate) fn put(place: &mut Real, mask: Real, number: Real) {
    *place = mask.select(number, *place);
}

/// Adds a number in the lanes of a mask.
#[inline(always)]
pub(crate) fn add(place: &mut Real, mask: Real, number: Real) {
    *place = mask.select(*place + number, *place);
}

/// One number of one lane.
#[inline(always)]
pub(crate) fn get(numbers: &Real, lane: usize) -> f32 {
    numbers.as_array()[lane]
}

/// Sets the number of one lane.
#[inline(always)]
pub(crate) fn set(numbers: &mut Real, lane: usize, number: f32) {
    numbers.as_mut_array()[lane] = number;
}

/// A vector or point for each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vector {
    pub(crate) x: Real,
    pub(crate) y: Real,
}

impl Vector {
    pub(crate) const ZERO: Self = Self { x: Real::ZERO, y: Real::ZERO };

    /// The same vector in every lane.
    #[inline(always)]
    pub(crate) fn splat(vector: Vec2) -> Self {
        Self { x: splat(vector.x), y: splat(vector.y) }
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> Real {
        self.x * other.x + self.y * other.y
    }

    /// Turned counter-clockwise by a right angle.
    #[inline(always)]
    pub(crate) fn perp(self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    #[inline(always)]
    pub(crate) fn perp_dot(self, other: Self) -> Real {
        self.x * other.y - self.y * other.x
    }

    /// Another vector turned by the angle of this unit vector.
    #[inline(always)]
    pub(crate) fn rotate(self, other: Self) -> Self {
        Self { x: self.x * other.x - self.y * other.y, y: self.y * other.x + self.x * other.y }
    }

    #[inline(always)]
    pub(crate) fn length_squared(self) -> Real {
        self.dot(self)
    }

    #[inline(always)]
    pub(crate) fn length(self) -> Real {
        self.length_squared().sqrt()
    }

    #[inline(always)]
    pub(crate) fn distance_squared(self, other: Self) -> Real {
        (self - other).length_squared()
    }

    /// The unit vector in this direction, or another vector where there is none.
    #[inline(always)]
    pub(crate) fn normalize_or(self, other: Self) -> Self {
        let factor = splat(1.0) / self.length();
        let valid = greater(factor, Real::ZERO) & less(factor, splat(f32::INFINITY));
        Self::pick(valid, self * factor, other)
    }

    /// Component by component the smaller number.
    #[inline(always)]
    pub(crate) fn smaller(self, other: Self) -> Self {
        Self { x: smaller(self.x, other.x), y: smaller(self.y, other.y) }
    }

    /// Component by component the larger number.
    #[inline(always)]
    pub(crate) fn larger(self, other: Self) -> Self {
        Self { x: larger(self.x, other.x), y: larger(self.y, other.y) }
    }

    /// The larger of the components' absolute values.
    #[inline(always)]
    pub(crate) fn max_abs(self) -> Real {
        larger(self.x.abs(), self.y.abs())
    }

    /// `a` where the mask is set, `b` elsewhere.
    #[inline(always)]
    pub(crate) fn pick(mask: Real, a: Self, b: Self) -> Self {
        Self { x: pick(mask, a.x, b.x), y: pick(mask, a.y, b.y) }
    }

    /// Stores a vector in the lanes of a mask.
    #[inline(always)]
    pub(crate) fn put(&mut self, mask: Real, vector: Self) {
        *self = Self::pick(mask, vector, *self);
    }

    /// Adds a vector in the lanes of a mask.
    #[inline(always)]
    pub(crate) fn add(&mut self, mask: Real, vector: Self) {
        self.put(mask, *self + vector);
    }

    /// The vector of one lane.
    #[inline(always)]
    pub(crate) fn get(&self, lane: usize) -> Vec2 {
        Vec2::new(get(&self.x, lane), get(&self.y, lane))
    }

    /// Sets the vector of one lane.
    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, vector: Vec2) {
        set(&mut self.x, lane, vector.x);
        set(&mut self.y, lane, vector.y);
    }
}

impl Add for Vector {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl AddAssign for Vector {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Vector {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl SubAssign for Vector {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Mul<Real> for Vector {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: Real) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }
}

impl Neg for Vector {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y }
    }
}

/// [`crate::body::Twist`] for each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Twists {
    pub(crate) x: Real,
    pub(crate) y: Real,
    pub(crate) spin: Real,
}

impl Twists {
    pub(crate) const ZERO: Self = Self { x: Real::ZERO, y: Real::ZERO, spin: Real::ZERO };

    /// The linear part.
    #[inline(always)]
    pub(crate) fn linear(self) -> Vector {
        Vector { x: self.x, y: self.y }
    }

    #[inline(always)]
    pub(crate) fn new(linear: Vector, spin: Real) -> Self {
        Self { x: linear.x, y: linear.y, spin }
    }

    /// The twist of a unit impulse in a direction at an offset from the centre of mass.
    #[inline(always)]
    pub(crate) fn of_impulse(direction: Vector, offset: Vector) -> Self {
        Self::new(direction, offset.perp_dot(direction))
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> Real {
        self.x * other.x + self.y * other.y + self.spin * other.spin
    }

    /// Component by component the product.
    #[inline(always)]
    pub(crate) fn times(self, other: Self) -> Self {
        Self { x: self.x * other.x, y: self.y * other.y, spin: self.spin * other.spin }
    }

    /// The velocity along this impulse's direction that a unit of another impulse causes.
    #[inline(always)]
    pub(crate) fn through(self, other: Self, inverse_mass: Self) -> Real {
        self.dot(other.times(inverse_mass))
    }

    #[inline(always)]
    pub(crate) fn scaled(self, factor: Real) -> Self {
        Self { x: self.x * factor, y: self.y * factor, spin: self.spin * factor }
    }

    #[inline(always)]
    pub(crate) fn plus(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, spin: self.spin + other.spin }
    }

    /// `a` where the mask is set, `b` elsewhere.
    #[inline(always)]
    pub(crate) fn pick(mask: Real, a: Self, b: Self) -> Self {
        Self { x: pick(mask, a.x, b.x), y: pick(mask, a.y, b.y), spin: pick(mask, a.spin, b.spin) }
    }

    /// Stores a twist in the lanes of a mask.
    #[inline(always)]
    pub(crate) fn put(&mut self, mask: Real, twist: Self) {
        *self = Self::pick(mask, twist, *self);
    }

    /// Adds the effect of a multiple of an impulse on a body, in the lanes of a mask.
    #[inline(always)]
    pub(crate) fn push(&mut self, mask: Real, impulse: Self, times: Real, inverse_mass: Self) {
        self.put(mask, self.plus(impulse.times(inverse_mass).scaled(times)));
    }
}
