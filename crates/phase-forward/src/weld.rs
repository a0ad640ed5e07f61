//! A grip as a constraint: the held object's centre stays at one point of the agent, at one angle.

use crate::{
    body::{BodyMotion, Shape, Twist},
    constants::{ANGULAR_SLOP, LINEAR_SLOP},
};
use glam::Vec3;
use phase_model::{Entity, Grip, Vec2};

/// An agent's grip of an object and all data for its solution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weld {
    pub(crate) agent: usize,
    pub(crate) object: usize,
    /// The object's place in the agent's frame, from its centre of mass (u).
    anchor: Vec2,
    relative_angle: f32,
    offset: Vec2,
    inverse: Symmetric,
    /// Accumulated impulse (N s) and angular impulse (N u s).
    pub(crate) impulse: (Vec2, f32),
}

impl Weld {
    /// The constraint of a grip of an agent (body 0 or 1), with the impulse of the substep before.
    pub(crate) fn new(agent: usize, grip: &Grip, shapes: &[Shape; 5], impulse: (Vec2, f32)) -> Self {
        let object = held_body(grip);
        let holder = &shapes[agent];
        let held = &shapes[object];
        let reach = grip.side.direction() * (holder.radius + held.radius);
        Self {
            agent,
            object,
            anchor: reach + Vec2::new(0.0, holder.origin),
            relative_angle: grip.relative_angle,
            offset: Vec2::ZERO,
            inverse: Symmetric::ZERO,
            impulse,
        }
    }

    /// Computes the effect of impulses at the present poses, and applies the accumulated ones.
    pub(crate) fn prepare(
        &mut self,
        shapes: &[Shape; 5],
        motions: &[BodyMotion; 5],
        twists: &mut [Twist; 5],
    ) {
        self.offset = motions[self.agent].turn(self.anchor);
        self.inverse = response(&shapes[self.agent], &shapes[self.object], self.offset).inverse();
        let (impulse, twist) = self.impulse;
        self.apply(shapes, twists, impulse, twist);
    }

    /// One iteration of the velocity solver. Returns the maximum change of an impulse.
    #[inline]
    pub(crate) fn solve(&mut self, shapes: &[Shape; 5], twists: &mut [Twist; 5]) -> f32 {
        let (agent, agent_spin) = twists[self.agent].parts();
        let (object, object_spin) = twists[self.object].parts();
        let slip = object - agent - self.offset.perp() * agent_spin;
        let (impulse, twist) = self.inverse.times(-slip, agent_spin - object_spin);
        self.impulse.0 += impulse;
        self.impulse.1 += twist;
        self.apply(shapes, twists, impulse, twist);
        impulse.x.abs().max(impulse.y.abs()).max(twist.abs())
    }

    /// One iteration of the position solver. Returns whether the error was negligible.
    pub(crate) fn join(&self, shapes: &[Shape; 5], motions: &mut [BodyMotion; 5]) -> bool {
        let shape_a = &shapes[self.agent];
        let shape_b = &shapes[self.object];
        let agent = &motions[self.agent];
        let object = &motions[self.object];
        let offset = agent.turn(self.anchor);
        let separation = object.centre - agent.centre - offset;
        let twisted = object.angle - agent.angle - self.relative_angle;
        let (impulse, twist) = response(shape_a, shape_b, offset).inverse().times(-separation, -twisted);
        motions[self.agent].shift(shape_a, offset, -impulse, -twist);
        motions[self.object].shift(shape_b, Vec2::ZERO, impulse, twist);
        separation.length_squared() <= LINEAR_SLOP * LINEAR_SLOP && twisted.abs() <= ANGULAR_SLOP
    }

    #[inline]
    fn apply(&self, shapes: &[Shape; 5], twists: &mut [Twist; 5], impulse: Vec2, twist: f32) {
        let on_agent = Vec3::new(impulse.x, impulse.y, self.offset.perp_dot(impulse) + twist);
        twists[self.agent].push(Twist(on_agent), -1.0, shapes[self.agent].inverse_mass_vector);
        let on_object = Vec3::new(impulse.x, impulse.y, twist);
        twists[self.object].push(Twist(on_object), 1.0, shapes[self.object].inverse_mass_vector);
    }
}

/// Index of the body that a grip holds.
pub(crate) fn held_body(grip: &Grip) -> usize {
    Entity::Object(grip.object).index()
}

/// The effect of a unit impulse and a unit twist between an agent, at an offset, and an object's centre.
fn response(agent: &Shape, object: &Shape, offset: Vec2) -> Symmetric {
    let mass = agent.inverse_mass + object.inverse_mass;
    let inverse_mass_vector = agent.inverse_inertia;
    Symmetric {
        xx: mass + offset.y * offset.y * inverse_mass_vector,
        xy: -offset.y * offset.x * inverse_mass_vector,
        xz: -offset.y * inverse_mass_vector,
        yy: mass + offset.x * offset.x * inverse_mass_vector,
        yz: offset.x * inverse_mass_vector,
        zz: inverse_mass_vector + object.inverse_inertia,
    }
}

/// A symmetric 3×3 matrix over (x, y, turn).
#[derive(Clone, Copy, Debug)]
struct Symmetric {
    xx: f32,
    xy: f32,
    xz: f32,
    yy: f32,
    yz: f32,
    zz: f32,
}

impl Symmetric {
    const ZERO: Self = Self { xx: 0.0, xy: 0.0, xz: 0.0, yy: 0.0, yz: 0.0, zz: 0.0 };

    /// The inverse, or zero for a singular matrix.
    fn inverse(&self) -> Self {
        let Self { xx, xy, xz, yy, yz, zz } = *self;
        let minors = (yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy);
        let determinant = xx * minors.0 + xy * minors.1 + xz * minors.2;
        let scale = if determinant == 0.0 { 0.0 } else { 1.0 / determinant };
        Self {
            xx: scale * minors.0,
            xy: scale * minors.1,
            xz: scale * minors.2,
            yy: scale * (xx * zz - xz * xz),
            yz: scale * (xz * xy - xx * yz),
            zz: scale * (xx * yy - xy * xy),
        }
    }

    #[inline]
    fn times(&self, v: Vec2, z: f32) -> (Vec2, f32) {
        (
            Vec2::new(
                self.xx * v.x + self.xy * v.y + self.xz * z,
                self.xy * v.x + self.yy * v.y + self.yz * z,
            ),
            self.xz * v.x + self.yz * v.y + self.zz * z,
        )
    }
}
