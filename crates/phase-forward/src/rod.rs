//! A grip as the published planner imagines it: a stiff spring between two body origins, free to pivot at
//! both ends.

use crate::{
    body::{BodyMotion, Shape, Twist},
    constants::H,
    weld::held_body,
};
use glam::Vec3;
use phase_model::{Grip, Vec2};

/// Frequency of the spring (rad/s): 100 Hz.
const ANGULAR_FREQUENCY: f32 = 200.0 * core::f32::consts::PI;
/// Its damping ratio.
const DAMPING_RATIO: f32 = 0.5;

/// A spring between an agent's origin and the centre of the object it holds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rod {
    pub(crate) agent: usize,
    pub(crate) object: usize,
    /// Length at which the spring pulls neither way (u).
    rest_length: f32,
    /// Unit vector from the agent's origin to the object's centre.
    direction: Vec2,
    /// The agent's origin, from its centre of mass (u).
    offset: Vec2,
    /// Effective mass of the spring (kg), and its softness (1/kg).
    mass: f32,
    softness: f32,
    /// Velocity with which it returns to its rest length (u/s).
    bias: f32,
    /// Accumulated impulse (N s).
    pub(crate) impulse: f32,
}

impl Rod {
    /// The spring of a grip of an agent (body 0 or 1), with the impulse of the substep before.
    pub(crate) fn new(agent: usize, grip: &Grip, rest_length: f32, impulse: f32) -> Self {
        Self {
            agent,
            object: held_body(grip),
            rest_length,
            direction: Vec2::ZERO,
            offset: Vec2::ZERO,
            mass: 0.0,
            softness: 0.0,
            bias: 0.0,
            impulse,
        }
    }

    /// Computes the effect of impulses at the present poses, and applies the accumulated one. Origins that
    /// coincide have no direction, and the spring no effect.
    pub(crate) fn prepare(
        &mut self,
        shapes: &[Shape; 5],
        motions: &[BodyMotion; 5],
        twists: &mut [Twist; 5],
    ) {
        let shape = &shapes[self.agent];
        let held = &shapes[self.object];
        self.offset = motions[self.agent].turn(Vec2::new(0.0, shape.origin));
        let between = motions[self.object].centre - motions[self.agent].centre - self.offset;
        let length = between.length();
        self.direction = between.normalize_or_zero();
        let lever = self.offset.perp_dot(self.direction);
        let inverse_mass = shape.inverse_mass + held.inverse_mass + lever * lever * shape.inverse_inertia;
        let mass = 1.0 / inverse_mass;
        let stiffness = mass * ANGULAR_FREQUENCY * ANGULAR_FREQUENCY;
        let damping = 2.0 * mass * DAMPING_RATIO * ANGULAR_FREQUENCY;
        self.softness = 1.0 / (H * (damping + H * stiffness));
        self.bias = (length - self.rest_length) * H * stiffness * self.softness;
        self.mass = 1.0 / (inverse_mass + self.softness);
        self.apply(shapes, twists, self.impulse);
    }

    /// One iteration of the velocity solver. Returns the change of the impulse.
    #[inline]
    pub(crate) fn solve(&mut self, shapes: &[Shape; 5], twists: &mut [Twist; 5]) -> f32 {
        let (agent, spin) = twists[self.agent].parts();
        let (object, _) = twists[self.object].parts();
        let stretch = self.direction.dot(object - agent - self.offset.perp() * spin);
        let change = -self.mass * (stretch + self.bias + self.softness * self.impulse);
        self.impulse += change;
        self.apply(shapes, twists, change);
        change.abs()
    }

    #[inline]
    fn apply(&self, shapes: &[Shape; 5], twists: &mut [Twist; 5], impulse: f32) {
        let on_agent = Twist::of_impulse(self.direction, self.offset);
        twists[self.agent].push(on_agent, -impulse, shapes[self.agent].inverse_mass_vector);
        let on_object = Twist(Vec3::new(self.direction.x, self.direction.y, 0.0));
        twists[self.object].push(on_object, impulse, shapes[self.object].inverse_mass_vector);
    }
}
