//! Ground friction: a force-limited motor between each body's origin and the ground.

use phase_model::{Vec2, arena::SUBSTEP_SECONDS, physique::GROUND_FRICTION};
use rapier2d::prelude::*;

/// Strength of the motor's velocity target; large enough that only the force limit matters.
const MOTOR_DAMPING: f32 = 1.0e8;
const AXES: [JointAxis; 2] = [JointAxis::LinX, JointAxis::LinY];

/// Ties a body's origin to the ground by two motors at right angles that aim at standing still.
pub fn insert(engine: &mut PhysicsWorld, ground: RigidBodyHandle, body: RigidBodyHandle) -> ImpulseJointHandle {
    let mut builder = GenericJointBuilder::new(JointAxesMask::empty());
    for axis in AXES {
        builder = builder.motor_velocity(axis, 0.0, MOTOR_DAMPING).motor_max_force(axis, GROUND_FRICTION);
    }
    engine.insert_impulse_joint(ground, body, builder.build())
}

/// Aims a body's friction against the velocity its origin would have after this substep without friction
/// (u/s). A body that friction can stop within the substep is held in every direction.
pub fn aim(engine: &mut PhysicsWorld, joint: ImpulseJointHandle, velocity: Vec2, inverse_mass: f32) {
    let Some(joint) = engine.impulse_joints.get_mut(joint, false) else { return };
    let speed = velocity.length();
    let direction = if speed > 0.0 { velocity / speed } else { Vec2::X };
    let slow = speed <= GROUND_FRICTION * inverse_mass * SUBSTEP_SECONDS;
    joint.data.set_local_frame1(Pose::from_parts(
        Vec2::ZERO,
        Rotation::from_cos_sin_unchecked(direction.x, direction.y),
    ));
    joint.data.set_motor_max_force(JointAxis::LinY, if slow { GROUND_FRICTION } else { 0.0 });
}
