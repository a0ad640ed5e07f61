//! One body: its constant properties and its motion.

use crate::{
    constants::{H, MAX_FRICTION_IMPULSE, SKIN},
    turn::{cos_sin, turned},
};
use glam::Vec3;
use phase_model::{
    Action, AgentBody, Body, Vec2,
    physics::{self, MAX_ROTATION, MAX_TRANSLATION},
};

/// Index of the static body.
pub(crate) const STATIC: usize = 4;

/// Mass, shape and forces of one body. All points are relative to the centre of mass, in the body's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    pub(crate) inverse_mass: f32,
    pub(crate) inverse_inertia: f32,
    /// Inverse mass (twice) and inverse inertia, to go with a [`Twist`].
    pub(crate) inverse_mass_vector: Vec3,
    pub(crate) mass: f32,
    /// Reduction of the effective mass for a lateral force at the origin, compared with the mass (kg).
    pub(crate) lateral_mass_reduction: f32,
    /// Distance of the origin ahead of the centre of mass (u).
    pub(crate) origin: f32,
    /// R of an agent, r of an object (u).
    pub(crate) radius: f32,
    /// Thickness around the corners (or the one point of a disc) within which contacts act (u).
    pub(crate) skin: f32,
    /// Radius of the circle about the centre of mass that encloses the body, skin included (u).
    pub(crate) bounding_radius: f32,
    /// Corners of an agent, counter-clockwise from the right end of its base.
    pub(crate) corners: [Vec2; 4],
    /// Outward normals of the sides that begin at those corners.
    pub(crate) normals: [Vec2; 4],
    /// Maximum push (N); 0 for objects.
    pub(crate) max_force: f32,
    /// Torque of a turn (N u); 0 for objects.
    pub(crate) turn_torque: f32,
    /// Distance of the point where pushes act ahead of the centre of mass (u).
    pub(crate) push_point: f32,
}

impl Shape {
    pub(crate) fn agent(agent: &AgentBody) -> Self {
        let radius = agent.radius;
        let origin = agent.centre_of_mass_offset();
        let corners = [(1.5, -1.0), (0.5, 1.0), (-0.5, 1.0), (-1.5, -1.0)]
            .map(|(x, y)| Vec2::new(x * radius, y * radius + origin));
        let normals =
            core::array::from_fn(|k| -(corners[(k + 1) % 4] - corners[k]).perp().normalize_or_zero());
        let inverse_mass = 1.0 / agent.mass();
        let inverse_inertia = 1.0 / agent.inertia();
        Self {
            inverse_mass,
            inverse_inertia,
            inverse_mass_vector: Vec3::new(inverse_mass, inverse_mass, inverse_inertia),
            mass: agent.mass(),
            lateral_mass_reduction: agent.mass() - 1.0 / (inverse_mass + origin * origin * inverse_inertia),
            origin,
            radius,
            skin: SKIN,
            bounding_radius: corners[0].length() + SKIN,
            corners,
            normals,
            max_force: agent.max_force,
            turn_torque: agent.turn_torque(),
            push_point: origin - agent.push_point_offset(),
        }
    }

    pub(crate) fn object(radius: f32) -> Self {
        let mass = physics::object_mass(radius);
        let inverse_mass = 1.0 / mass;
        let inverse_inertia = 1.0 / physics::object_inertia(radius);
        Self {
            inverse_mass,
            inverse_inertia,
            inverse_mass_vector: Vec3::new(inverse_mass, inverse_mass, inverse_inertia),
            mass,
            lateral_mass_reduction: 0.0,
            radius,
            skin: radius,
            bounding_radius: radius,
            ..Self::immovable()
        }
    }

    /// The static body, walls above all.
    pub(crate) const fn immovable() -> Self {
        Self {
            inverse_mass: 0.0,
            inverse_inertia: 0.0,
            inverse_mass_vector: Vec3::ZERO,
            mass: 0.0,
            lateral_mass_reduction: 0.0,
            origin: 0.0,
            radius: 0.0,
            skin: SKIN,
            bounding_radius: 0.0,
            corners: [Vec2::ZERO; 4],
            normals: [Vec2::ZERO; 4],
            max_force: 0.0,
            turn_torque: 0.0,
            push_point: 0.0,
        }
    }
}

/// Pose and velocity of one body, about its centre of mass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyMotion {
    /// Centre of mass (u).
    pub(crate) centre: Vec2,
    /// Velocity of the centre of mass (u/s).
    pub(crate) velocity: Vec2,
    /// Cosine and sine of the angle, which is also the unit vector to the body's right. Discs keep (1, 0).
    pub(crate) right: Vec2,
    /// Angle (rad).
    pub(crate) angle: f32,
    /// Angular velocity (rad/s).
    pub(crate) spin: f32,
}

impl BodyMotion {
    /// At rest at the origin, the frame in which walls are given.
    pub(crate) const AT_REST: Self =
        Self { centre: Vec2::ZERO, velocity: Vec2::ZERO, right: Vec2::X, angle: 0.0, spin: 0.0 };

    pub(crate) fn of_agent(body: &Body, shape: &Shape) -> Self {
        let right = cos_sin(body.angle);
        Self {
            centre: body.position - right.perp() * shape.origin,
            velocity: body.velocity,
            right,
            angle: body.angle,
            spin: body.angular_velocity,
        }
    }

    pub(crate) const fn of_object(body: &Body) -> Self {
        Self {
            centre: body.position,
            velocity: body.velocity,
            right: Vec2::X,
            angle: body.angle,
            spin: body.angular_velocity,
        }
    }

    pub(crate) fn body(&self, shape: &Shape) -> Body {
        Body {
            position: self.centre + self.right.perp() * shape.origin,
            velocity: self.velocity,
            angle: self.angle,
            angular_velocity: self.spin,
        }
    }

    /// Transforms a vector from the body's frame to the world's.
    #[inline]
    pub(crate) fn turn(&self, local: Vec2) -> Vec2 {
        self.right * local.x + self.right.perp() * local.y
    }

    /// Transforms a vector from the world's frame to the body's.
    #[inline]
    pub(crate) fn local_vector(&self, vector: Vec2) -> Vec2 {
        Vec2::new(vector.dot(self.right), vector.dot(self.right.perp()))
    }

    /// Transforms a point from the body's frame to the world's.
    #[inline]
    pub(crate) fn place(&self, local: Vec2) -> Vec2 {
        self.centre + self.turn(local)
    }

    /// Moves the pose as an impulse at an offset would change the velocity.
    #[inline]
    pub(crate) fn shift(&mut self, shape: &Shape, offset: Vec2, impulse: Vec2, twist: f32) {
        self.centre += impulse * shape.inverse_mass;
        self.rotate((offset.perp_dot(impulse) + twist) * shape.inverse_inertia, shape);
    }

    /// Adds to the angle.
    #[inline]
    pub(crate) fn rotate(&mut self, by: f32, shape: &Shape) {
        if by != 0.0 {
            self.angle += by;
            // Only an agent's shape depends on its angle.
            if shape.origin > 0.0 {
                self.right = turned(self.right, by);
            }
        }
    }

    /// Applies an action of an agent that pushes with at most some force (N) for one substep, before friction
    /// and contacts.
    #[inline]
    pub(crate) fn act(&mut self, shape: &Shape, action: Action, max_force: f32) {
        if let Some(push) = action.push() {
            let force = push * max_force;
            self.velocity += self.turn(force) * (H * shape.inverse_mass);
            self.spin -= shape.push_point * force.x * (H * shape.inverse_inertia);
        } else if action == Action::Stop {
            self.velocity = Vec2::ZERO;
        } else {
            self.spin += action.turn() * shape.turn_torque * (H * shape.inverse_inertia);
        }
    }

    /// Whether linear and angular velocity are zero.
    #[inline]
    pub(crate) fn is_at_rest(&self) -> bool {
        self.velocity == Vec2::ZERO && self.spin == 0.0
    }

    /// Advances by one substep under ground friction alone. Returns the impulse of the friction.
    #[inline]
    pub(crate) fn coast(&mut self, shape: &Shape) -> Vec2 {
        if self.is_at_rest() {
            return Vec2::ZERO;
        }
        let mut twist = self.twist();
        let rubbed = twist.solve_friction(shape, self.right, Vec2::ZERO);
        self.set_twist(twist);
        self.advance(shape, H);
        rubbed
    }

    /// The velocity as one vector.
    #[inline]
    pub(crate) fn twist(&self) -> Twist {
        Twist(Vec3::new(self.velocity.x, self.velocity.y, self.spin))
    }

    /// Sets the velocity.
    #[inline]
    pub(crate) fn set_twist(&mut self, twist: Twist) {
        (self.velocity, self.spin) = twist.parts();
    }

    /// Advances by some seconds, after limiting the velocity.
    #[inline]
    pub(crate) fn advance(&mut self, shape: &Shape, seconds: f32) {
        let sweep = self.velocity * seconds;
        let length_squared = sweep.length_squared();
        if length_squared > MAX_TRANSLATION * MAX_TRANSLATION {
            self.velocity *= MAX_TRANSLATION / length_squared.sqrt();
        }
        let turn = self.spin * seconds;
        if turn * turn > MAX_ROTATION * MAX_ROTATION {
            self.spin *= MAX_ROTATION / turn.abs();
        }
        self.centre += self.velocity * seconds;
        self.rotate(self.spin * seconds, shape);
    }
}

/// A velocity (x, y and spin), or an impulse in the same three coordinates, as one vector that is read and
/// written as a whole, since the velocity solver does little else.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Twist(pub(crate) Vec3);

impl Twist {
    pub(crate) const ZERO: Self = Self(Vec3::ZERO);

    /// The linear part (velocity or impulse) and the spin.
    #[inline]
    pub(crate) fn parts(self) -> (Vec2, f32) {
        (Vec2::new(self.0.x, self.0.y), self.0.z)
    }

    /// The twist of a unit impulse in a direction at an offset from the centre of mass.
    #[inline]
    pub(crate) fn of_impulse(direction: Vec2, offset: Vec2) -> Self {
        Self(Vec3::new(direction.x, direction.y, offset.perp_dot(direction)))
    }

    /// The velocity along an impulse's direction.
    #[inline]
    pub(crate) fn dot(self, other: Self) -> f32 {
        self.0.dot(other.0)
    }

    /// The velocity along this impulse's direction that a unit of another impulse causes.
    #[inline]
    pub(crate) fn through(self, other: Self, inverse_mass_vector: Vec3) -> f32 {
        self.dot(Self(other.0 * inverse_mass_vector))
    }

    /// Adds the effect of a multiple of an impulse on a body.
    #[inline]
    pub(crate) fn push(&mut self, impulse: Self, times: f32, inverse_mass_vector: Vec3) {
        self.0 += impulse.0 * inverse_mass_vector * times;
    }

    /// One iteration of ground friction, which acts at the body's origin with at most 100 N. Takes and
    /// returns the accumulated impulse of this substep. For a body on which nothing else acts, one iteration
    /// is exact whatever the initial value.
    #[inline]
    pub(crate) fn solve_friction(&mut self, shape: &Shape, right: Vec2, so_far: Vec2) -> Vec2 {
        let (velocity, spin) = self.parts();
        let slip = velocity - right * (spin * shape.origin);
        let wanted = so_far - slip * shape.mass + right * (right.dot(slip) * shape.lateral_mass_reduction);
        let length_squared = wanted.length_squared();
        let given = if length_squared > MAX_FRICTION_IMPULSE * MAX_FRICTION_IMPULSE {
            wanted * (MAX_FRICTION_IMPULSE / length_squared.sqrt())
        } else {
            wanted
        };
        self.apply_friction(shape, right, given - so_far);
        given
    }

    /// Applies an impulse of ground friction.
    #[inline]
    pub(crate) fn apply_friction(&mut self, shape: &Shape, right: Vec2, impulse: Vec2) {
        let twist = -right.dot(impulse) * shape.origin;
        self.0 += Vec3::new(impulse.x, impulse.y, twist) * shape.inverse_mass_vector;
    }
}
