//! Ground friction: a force-limited motor between each body's origin and the ground.
//!
//! The published world limits the length of the friction force, whatever its direction; rapier's motors limit
//! each axis on its own. So a sliding body gets one motor, aimed along the impulse that would stop it, and a
//! body that does not slide is held by a second one across.

use phase_model::{Vec2, arena::SUBSTEP_SECONDS, physique::GROUND_FRICTION};
use rapier2d::prelude::*;

/// Strength of the motor's velocity target; large enough that only the force limit matters.
const MOTOR_DAMPING: f32 = 1.0e8;
const AXES: [JointAxis; 2] = [JointAxis::LinX, JointAxis::LinY];
/// Greatest impulse of ground friction in one substep (N s).
pub const IMPULSE: f32 = GROUND_FRICTION * SUBSTEP_SECONDS;

/// Ties a body's origin to the ground by two motors at right angles that aim at standing still.
pub fn insert(engine: &mut PhysicsWorld, ground: RigidBodyHandle, body: RigidBodyHandle) -> ImpulseJointHandle {
    let mut builder = GenericJointBuilder::new(JointAxesMask::empty());
    for axis in AXES {
        builder = builder.motor_velocity(axis, 0.0, MOTOR_DAMPING).motor_max_force(axis, GROUND_FRICTION);
    }
    engine.insert_impulse_joint(ground, body, builder.build())
}

/// Aims a body's friction along `axis`; `hold` has it act across, too.
pub fn aim(engine: &mut PhysicsWorld, joint: ImpulseJointHandle, axis: Vec2, hold: bool) {
    let Some(joint) = engine.impulse_joints.get_mut(joint, false) else { return };
    let direction = axis.normalize_or(Vec2::X);
    joint.data.set_local_frame1(Pose::from_parts(
        Vec2::ZERO,
        Rotation::from_cos_sin_unchecked(direction.x, direction.y),
    ));
    joint.data.set_motor_max_force(JointAxis::LinY, if hold { GROUND_FRICTION } else { 0.0 });
}

/// The impulse that friction exerted in the last substep (N s).
pub fn exerted(engine: &PhysicsWorld, joint: ImpulseJointHandle) -> Vec2 {
    let Some(joint) = engine.impulse_joints.get(joint) else { return Vec2::ZERO };
    let impulse = |axis| joint.data.motor(axis).map_or(0.0, |motor| motor.impulse);
    joint.data.local_frame1.rotation * Vec2::new(impulse(AXES[0]), impulse(AXES[1]))
}

/// The velocity of a body's origin after this substep if nothing but its own push acted (u/s).
pub fn origin_velocity(body: &RigidBody, with_forces: bool) -> Vec2 {
    let mass = &body.mass_properties().local_mprops;
    let dt = if with_forces { SUBSTEP_SECONDS } else { 0.0 };
    let velocity = body.linvel() + body.user_force() * (mass.inv_mass * dt);
    let spin = body.angvel() + body.user_torque() * (mass.inv_principal_inertia * dt);
    velocity + (body.translation() - body.center_of_mass()).perp() * spin
}

/// The impulse at a body's origin that gives the origin a velocity (N s).
pub fn impulse_for(body: &RigidBody, velocity: Vec2) -> Vec2 {
    let arm = body.translation() - body.center_of_mass();
    impulse_for2(body, arm, velocity)
}
/// .
pub fn impulse_for2(body: &RigidBody, arm: Vec2, velocity: Vec2) -> Vec2 {
    let mass = &body.mass_properties().local_mprops;
    // K = (1/m) 1 + (1/I) a⊥ a⊥ᵀ has the eigenvectors a⊥ and a.
    let across = arm.perp();
    let length_squared = across.length_squared();
    let plain = velocity / mass.inv_mass;
    if length_squared == 0.0 {
        return plain;
    }
    let share = across * (across.dot(velocity) / length_squared);
    let turning = 1.0 / (mass.inv_mass + mass.inv_principal_inertia * length_squared);
    plain + share * (turning - 1.0 / mass.inv_mass)
}
