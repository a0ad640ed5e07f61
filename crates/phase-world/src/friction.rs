//! Ground friction: force-limited motors between each body's origin and the ground.
//!
//! The ground resists with at most 100 N at a body's origin, against the direction in which the origin
//! slides. rapier's motors limit the force along each axis separately. So a sliding body gets one motor,
//! aligned with the impulse that would stop its origin, and a body that does not slide is held by a second
//! one, perpendicular to the first. For a free body the direction is known before the substep, from its
//! velocity and its push. With contacts and welds it is only known afterwards; [`FrictionDirection::after`]
//! then determines whether the substep has to be repeated with a better direction.

use phase_model::{Vec2, arena::SUBSTEP_SECONDS, physics::GROUND_FRICTION};
use rapier2d::prelude::*;

/// The axes of the main motor and of the perpendicular one.
const AXES: [JointAxis; 2] = [JointAxis::LinX, JointAxis::LinY];
/// Gain of the motors' velocity target; so large that only the force limit matters.
const MOTOR_GAIN: f32 = 1.0e8;
/// Maximum impulse of friction in one substep (N s).
const MAX_IMPULSE: f32 = GROUND_FRICTION * SUBSTEP_SECONDS;
/// Stopping impulse below which a body counts as resting (N s); such a body creeps by less than 1e-4 u in a
/// whole event.
const REST_IMPULSE: f32 = 1.0e-5;
/// Sine of the angle below which two directions count as equal.
const DIRECTION_TOLERANCE: f32 = 1.0e-3;

/// Connects a body's origin to the ground by two perpendicular motors with target velocity zero.
pub(crate) fn insert(
    engine: &mut PhysicsWorld,
    ground: RigidBodyHandle,
    body: RigidBodyHandle,
) -> ImpulseJointHandle {
    let joint = AXES.into_iter().fold(GenericJointBuilder::new(JointAxesMask::empty()), |joint, axis| {
        joint.motor_velocity(axis, 0.0, MOTOR_GAIN).motor_max_force(axis, GROUND_FRICTION)
    });
    engine.insert_impulse_joint(ground, body, joint.build())
}

/// Direction of a body's friction in one substep.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct FrictionDirection {
    /// Unit vector of the main motor, or zero for no friction at all.
    axis: Vec2,
    /// Whether the perpendicular motor is also active.
    hold: bool,
}

impl FrictionDirection {
    /// The direction for a free body whose forces are set for the coming substep.
    #[must_use]
    pub(crate) fn predicted(body: &RigidBody) -> Self {
        let mass = &body.mass_properties().local_mprops;
        let velocity = body.linvel() + body.user_force() * (mass.inv_mass * SUBSTEP_SECONDS);
        let spin = body.angvel() + body.user_torque() * (mass.inv_principal_inertia * SUBSTEP_SECONDS);
        let slip = stopping_impulse(body, body.rotation(), velocity, spin);
        Self::against(slip)
    }

    /// The direction that follows from the motion after a substep: against the slip that would have occurred
    /// without friction. `rotation` is the body's before the substep.
    pub(crate) fn after(
        engine: &PhysicsWorld,
        body: &RigidBody,
        rotation: &Rotation,
        joint: ImpulseJointHandle,
    ) -> Self {
        let slip = stopping_impulse(body, rotation, body.linvel(), body.angvel());
        Self::against(slip + exerted(engine, joint))
    }

    /// The direction against a slip, given as the impulse that would stop it.
    fn against(slip: Vec2) -> Self {
        let impulse = slip.length();
        if impulse <= REST_IMPULSE {
            // Other bodies may be about to move a resting body; an iteration without its friction shows in
            // which direction.
            return Self { axis: Vec2::ZERO, hold: false };
        }
        Self { axis: slip / impulse, hold: impulse <= MAX_IMPULSE }
    }

    /// Whether two directions are equivalent.
    #[must_use]
    pub(crate) fn is_close_to(&self, other: &Self) -> bool {
        self.axis == other.axis
            || self.axis.perp_dot(other.axis).abs() <= DIRECTION_TOLERANCE && self.axis.dot(other.axis) != 0.0
    }

    /// Sets a body's friction for the coming substep.
    pub(crate) fn apply(self, engine: &mut PhysicsWorld, joint: ImpulseJointHandle) {
        let axis = if self.axis == Vec2::ZERO { Vec2::X } else { self.axis };
        let force = |acts: bool| if acts { GROUND_FRICTION } else { 0.0 };
        let forces = [force(self.axis != Vec2::ZERO), force(self.hold)];
        let rotation = Rotation::from_cos_sin_unchecked(axis.x, axis.y);
        let is_set = |joint: &ImpulseJoint| {
            joint.data.local_frame1.rotation == rotation
                && AXES.map(|axis| joint.data.motor(axis).map(|motor| motor.max_force)) == forces.map(Some)
        };
        // Accessing a joint mutably makes the engine process all joints again.
        if engine.impulse_joints.get(joint).is_none_or(is_set) {
            return;
        }
        if let Some(joint) = engine.impulse_joints.get_mut(joint, false) {
            joint.data.set_local_frame1(Pose::from_rotation(rotation));
            for (axis, force) in AXES.into_iter().zip(forces) {
                joint.data.set_motor_max_force(axis, force);
            }
        }
    }
}

/// The impulse at a body's origin that, subtracted from its momentum, stops the origin (N s).
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

/// The impulse that friction took from a body in the last substep (N s).
fn exerted(engine: &PhysicsWorld, joint: ImpulseJointHandle) -> Vec2 {
    let Some(joint) = engine.impulse_joints.get(joint) else { return Vec2::ZERO };
    let impulse = |axis| joint.data.motor(axis).map_or(0.0, |motor| motor.impulse);
    joint.data.local_frame1.rotation * Vec2::from(AXES.map(impulse))
}
