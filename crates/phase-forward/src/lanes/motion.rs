//! Pose and velocity of one body in each lane; see [`crate::body::BodyMotion`].

use super::real::{
    LANES, LaneSet, Real, Twists, Vector, add, at_most, differ, each, equal, get, greater, lanes, mask, put,
    set, splat,
};
use crate::{
    body::{BodyMotion, Shape},
    constants::{H, MAX_FRICTION_IMPULSE, MAX_ROTATION, MAX_TRANSLATION},
    turn::{SMALL, turned},
};
use phase_model::{Action, Vec2};

/// What an agent does in each lane, prepared for a substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LaneActions {
    /// Pushes as a multiple of the agent's force, and the lanes that push.
    pub(crate) push: Vector,
    /// Maximum push (N).
    pub(crate) max_force: Real,
    pub(crate) pushes: Real,
    /// The lanes that stop.
    pub(crate) stops: Real,
    /// [`phase_model::Action::turn`].
    pub(crate) turn: Real,
}

impl LaneActions {
    pub(crate) const NONE: Self = Self {
        push: Vector::ZERO,
        max_force: Real::ZERO,
        pushes: Real::ZERO,
        stops: Real::ZERO,
        turn: Real::ZERO,
    };

    /// What an agent does in each lane, and its maximum push (N).
    pub(crate) fn new(acts_of: [(Action, f32); LANES]) -> Self {
        let mut acts = Self::NONE;
        let (mut pushes, mut stops): (LaneSet, LaneSet) = (0, 0);
        for (lane, (action, max_force)) in acts_of.into_iter().enumerate() {
            set(&mut acts.max_force, lane, max_force);
            acts.push.set(lane, action.push().unwrap_or(Vec2::ZERO));
            pushes |= u8::from(action.push().is_some()) << lane;
            stops |= u8::from(action == Action::Stop) << lane;
            set(&mut acts.turn, lane, action.turn());
        }
        acts.pushes = mask(pushes);
        acts.stops = mask(stops);
        acts
    }

    /// The lanes in which nothing is done.
    pub(crate) fn idle(&self) -> Real {
        !(self.pushes) & equal(self.turn, Real::ZERO)
    }
}

/// One body in each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motions {
    pub(crate) centre: Vector,
    pub(crate) velocity: Vector,
    pub(crate) right: Vector,
    pub(crate) angle: Real,
    pub(crate) spin: Real,
}

impl Motions {
    pub(crate) const AT_REST: Self = Self {
        centre: Vector::ZERO,
        velocity: Vector::ZERO,
        right: Vector { x: Real::ONE, y: Real::ZERO },
        angle: Real::ZERO,
        spin: Real::ZERO,
    };

    /// The body of one lane.
    pub(crate) fn get(&self, lane: usize) -> BodyMotion {
        BodyMotion {
            centre: self.centre.get(lane),
            velocity: self.velocity.get(lane),
            right: self.right.get(lane),
            angle: get(&self.angle, lane),
            spin: get(&self.spin, lane),
        }
    }

    /// Sets the body of one lane.
    pub(crate) fn set(&mut self, lane: usize, motion: &BodyMotion) {
        self.centre.set(lane, motion.centre);
        self.velocity.set(lane, motion.velocity);
        self.right.set(lane, motion.right);
        set(&mut self.angle, lane, motion.angle);
        set(&mut self.spin, lane, motion.spin);
    }

    /// Transforms a vector from the body's frame to the world's.
    #[inline(always)]
    pub(crate) fn turn(&self, local: Vector) -> Vector {
        self.right.rotate(local)
    }

    /// Transforms a vector from the world's frame to the body's.
    #[inline(always)]
    pub(crate) fn local_vector(&self, vector: Vector) -> Vector {
        Vector { x: vector.dot(self.right), y: vector.dot(self.right.perp()) }
    }

    /// Transforms a point from the body's frame to the world's.
    #[inline(always)]
    pub(crate) fn place(&self, local: Vector) -> Vector {
        self.centre + self.turn(local)
    }

    /// Moves the pose as an impulse at an offset would change the velocity.
    #[inline]
    pub(crate) fn shift(&mut self, mask: Real, shape: &Shape, offset: Vector, impulse: Vector, twist: Real) {
        self.centre.add(mask, impulse * splat(shape.inverse_mass));
        let by = (offset.perp_dot(impulse) + twist) * splat(shape.inverse_inertia);
        self.rotate(mask, by, shape);
    }

    /// Adds to the angle.
    #[inline]
    pub(crate) fn rotate(&mut self, mask: Real, by: Real, shape: &Shape) {
        let mask = mask & differ(by, Real::ZERO);
        add(&mut self.angle, mask, by);
        if shape.origin > 0.0 {
            self.right.put(mask, turned_lanes(lanes(mask), self.right, by));
        }
    }

    /// Applies an agent's action for one substep, before friction and contacts.
    #[inline]
    pub(crate) fn act(&mut self, mask: Real, shape: &Shape, action: &LaneActions) {
        let pushed = mask & action.pushes;
        let force = action.push * action.max_force;
        self.velocity.add(pushed, self.turn(force) * splat(H * shape.inverse_mass));
        let change = splat(shape.push_point) * force.x * splat(H * shape.inverse_inertia);
        add(&mut self.spin, pushed, -change);
        self.velocity.put(mask & action.stops, Vector::ZERO);
        let turn = action.turn * splat(shape.turn_torque) * splat(H * shape.inverse_inertia);
        add(&mut self.spin, mask & !(action.pushes | action.stops), turn);
    }

    /// The lanes in which linear and angular velocity are zero.
    #[inline(always)]
    pub(crate) fn at_rest(&self) -> Real {
        equal(self.velocity.x, Real::ZERO) & equal(self.velocity.y, Real::ZERO) & equal(self.spin, Real::ZERO)
    }

    /// Advances by one substep under ground friction alone. Returns the impulse of the friction.
    #[inline]
    pub(crate) fn coast(&mut self, mask: Real, shape: &Shape) -> Vector {
        let mask = mask & !self.at_rest();
        if !mask.any() {
            return Vector::ZERO;
        }
        let mut twist = self.twist();
        let rubbed = solve_friction(&mut twist, mask, shape, self.right, Vector::ZERO);
        self.set_twist(mask, twist);
        self.advance(mask, shape, splat(H));
        Vector::pick(mask, rubbed, Vector::ZERO)
    }

    /// The velocity.
    #[inline(always)]
    pub(crate) fn twist(&self) -> Twists {
        Twists::new(self.velocity, self.spin)
    }

    /// Sets the velocity.
    #[inline(always)]
    pub(crate) fn set_twist(&mut self, mask: Real, twist: Twists) {
        self.velocity.put(mask, twist.linear());
        put(&mut self.spin, mask, twist.spin);
    }

    /// Advances by some seconds, after limiting the velocity.
    #[inline]
    pub(crate) fn advance(&mut self, mask: Real, shape: &Shape, seconds: Real) {
        let length_squared = (self.velocity * seconds).length_squared();
        let fast = mask & greater(length_squared, splat(MAX_TRANSLATION * MAX_TRANSLATION));
        if fast.any() {
            self.velocity.put(fast, self.velocity * (splat(MAX_TRANSLATION) / length_squared.sqrt()));
        }
        let turn = self.spin * seconds;
        let fast = mask & greater(turn * turn, splat(MAX_ROTATION * MAX_ROTATION));
        if fast.any() {
            let limited = self.spin * (splat(MAX_ROTATION) / turn.abs());
            put(&mut self.spin, fast, limited);
        }
        self.centre.add(mask, self.velocity * seconds);
        self.rotate(mask, self.spin * seconds, shape);
    }
}

/// Unit vectors turned counter-clockwise by angles; only the given lanes of the result are meaningful. See [`turned`].
#[inline]
pub(crate) fn turned_lanes(set: LaneSet, vector: Vector, by: Real) -> Vector {
    let square = by * by;
    let one = splat(1.0);
    let cos = one
        - square
            * (splat(0.5)
                - square * (splat(1.0 / 24.0) - square * (splat(1.0 / 720.0) - square / splat(40320.0))));
    let sin =
        by * (one - square * (splat(1.0 / 6.0) - square * (splat(1.0 / 120.0) - square / splat(5040.0))));
    let mut result = Vector { x: cos, y: sin }.rotate(vector);
    let large = set & !lanes(at_most(by.abs(), splat(SMALL)));
    for lane in each(large) {
        result.set(lane, turned(vector.get(lane), get(&by, lane)));
    }
    result
}

/// One iteration of ground friction, which acts at the body's origin with at most 100 N; see
/// [`crate::body::Twist::solve_friction`].
#[inline]
pub(crate) fn solve_friction(
    twist: &mut Twists,
    mask: Real,
    shape: &Shape,
    right: Vector,
    so_far: Vector,
) -> Vector {
    let slip = twist.linear() - right * (twist.spin * splat(shape.origin));
    let wanted =
        so_far - slip * splat(shape.mass) + right * (right.dot(slip) * splat(shape.lateral_mass_reduction));
    let length_squared = wanted.length_squared();
    let slides = greater(length_squared, splat(MAX_FRICTION_IMPULSE * MAX_FRICTION_IMPULSE));
    let limited = wanted * (splat(MAX_FRICTION_IMPULSE) / length_squared.sqrt());
    let given = Vector::pick(slides, limited, wanted);
    apply_friction(twist, mask, shape, right, given - so_far);
    given
}

/// Applies an impulse of ground friction.
#[inline]
pub(crate) fn apply_friction(twist: &mut Twists, mask: Real, shape: &Shape, right: Vector, impulse: Vector) {
    let spin = -right.dot(impulse) * splat(shape.origin);
    let change = Twists::new(impulse, spin).times(inverse_mass(shape));
    twist.put(mask, twist.plus(change));
}

/// [`Shape::inverse_mass_vector`] in every lane.
#[inline(always)]
pub(crate) fn inverse_mass(shape: &Shape) -> Twists {
    let linear = Vector::splat(Vec2::splat(shape.inverse_mass));
    Twists::new(linear, splat(shape.inverse_inertia))
}
