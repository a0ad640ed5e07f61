//! Ground friction: force-limited motors between each body's origin and the ground.
//!
//! The ground resists with at most 100 N at a body's origin, against the direction in which the origin slides.
//! rapier's motors limit the force along each axis by itself. So a body that slides gets one motor, aimed
//! along the impulse that would stop its origin, and a body that does not is held by a second one across.
//! For a body on its own the direction is known before the substep, from its velocity and its push. Where
//! contacts and welds have a say it is only known afterwards; [`Aim::after`] then tells whether the substep
//! has to be taken again with a better aim.

use phase_model::{Vec2, arena::SUBSTEP_SECONDS, physique::GROUND_FRICTION};
use rapier2d::prelude::*;

/// Gain of the motors' velocity target; so large that only the force limit matters.
const MOTOR_GAIN: f32 = 1.0e8;
/// Greatest impulse of friction in one substep (N s).
const MAX_IMPULSE: f32 = GROUND_FRICTION * SUBSTEP_SECONDS;
/// Slip below which a body counts as held, as a share of the greatest impulse.
const HELD_SLIP: f32 = 0.01;
/// Sine of the angle by which two aims may differ without making a difference.
const SAME_AIM: f32 = 1.0e-3;

/// Ties a body's origin to the ground by two motors at right angles that aim at standing still.
pub(crate) fn insert(engine: &mut PhysicsWorld, ground: RigidBodyHandle, body: RigidBodyHandle) -> ImpulseJointHandle {
    let joint = [JointAxis::LinX, JointAxis::LinY].into_iter().fold(
        GenericJointBuilder::new(JointAxesMask::empty()),
        |joint, axis| joint.motor_velocity(axis, 0.0, MOTOR_GAIN).motor_max_force(axis, GROUND_FRICTION),
    );
    engine.insert_impulse_joint(ground, body, joint.build())
}

/// How a body's friction is directed in one substep.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Aim {
    /// Unit vector of the main motor.
    axis: Vec2,
    /// Whether the motor across acts, too.
    hold: bool,
}

impl Aim {
    /// The aim for a body on its own, whose forces are set for the coming substep.
    #[must_use]
    pub(crate) fn foreseen(body: &RigidBody) -> Self {
        let mass = &body.mass_properties().local_mprops;
        let velocity = body.linvel() + body.user_force() * (mass.inv_mass * SUBSTEP_SECONDS);
        let spin = body.angvel() + body.user_torque() * (mass.inv_principal_inertia * SUBSTEP_SECONDS);
        let slip = stopping_impulse(body, body.rotation(), velocity, spin);
        Self { axis: slip.normalize_or(Vec2::X), hold: slip.length() <= MAX_IMPULSE }
    }

    /// The aim that the motion after a substep calls for: along the origin's slip, or for a body held in place
    /// along the impulse that held it. `rotation` is the body's before the substep.
    #[must_use]
    pub(crate) fn after(engine: &PhysicsWorld, body: &RigidBody, rotation: &Rotation, joint: ImpulseJointHandle) -> Self {
        let slip = stopping_impulse(body, rotation, body.linvel(), body.angvel());
        let hold = slip.length() < HELD_SLIP * MAX_IMPULSE;
        let along = if hold { exerted(engine, joint) } else { slip };
        Self { axis: along.normalize_or(Vec2::X), hold }
    }

    /// Whether two aims come to the same.
    #[must_use]
    pub(crate) fn agrees_with(&self, other: &Self) -> bool {
        self.axis.perp_dot(other.axis).abs() <= SAME_AIM
    }

    /// Sets a body's friction for the coming substep.
    pub(crate) fn apply(self, engine: &mut PhysicsWorld, joint: ImpulseJointHandle) {
        let Some(joint) = engine.impulse_joints.get_mut(joint, false) else { return };
        let rotation = Rotation::from_cos_sin_unchecked(self.axis.x, self.axis.y);
        joint.data.set_local_frame1(Pose::from_rotation(rotation));
        joint.data.set_motor_max_force(JointAxis::LinY, if self.hold { GROUND_FRICTION } else { 0.0 });
    }
}

/// The impulse at a body's origin that would stop its origin (N s), up to its sign.
fn stopping_impulse(body: &RigidBody, rotation: &Rotation, velocity: Vec2, spin: f32) -> Vec2 {
    let mass = &body.mass_properties().local_mprops;
    let arm = *rotation * -mass.local_com;
    let slip = velocity + arm.perp() * spin;
    // The inverse of K = (1/m) 1 + (1/I) n nᵀ with n = arm⊥ (Sherman and Morrison).
    let across = arm.perp();
    let turned = mass.inv_principal_inertia * across.dot(slip)
        / (mass.inv_mass + mass.inv_principal_inertia * across.length_squared());
    (slip - across * turned) / mass.inv_mass
}

/// The impulse that friction exerted in the last substep, up to its sign (N s).
fn exerted(engine: &PhysicsWorld, joint: ImpulseJointHandle) -> Vec2 {
    let Some(joint) = engine.impulse_joints.get(joint) else { return Vec2::ZERO };
    let impulse = |axis| joint.data.motor(axis).map_or(0.0, |motor| motor.impulse);
    joint.data.local_frame1.rotation * Vec2::new(impulse(JointAxis::LinX), impulse(JointAxis::LinY))
}
