//! Grips: rigid welds between an agent and an object.

use phase_model::{Grip, Vec2};
use rapier2d::prelude::*;

/// A grip and the joint that enforces it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weld {
    /// The object held, the side and the relative angle.
    pub(crate) grip: Grip,
    joint: ImpulseJointHandle,
}

impl Weld {
    /// Welds an object's centre to the point of an agent at distance `length` = R + r on the grip's side. If
    /// they are apart, the next substep pulls them together. The two do not collide while welded.
    pub(crate) fn insert(
        engine: &mut PhysicsWorld,
        [agent, object]: [RigidBodyHandle; 2],
        grip: Grip,
        length: f32,
    ) -> Self {
        let joint = FixedJointBuilder::new()
            .local_frame1(crate::bodies::pose(grip.side.direction() * length, grip.relative_angle))
            .local_frame2(crate::bodies::pose(Vec2::ZERO, 0.0))
            .contacts_enabled(false);
        Self { grip, joint: engine.insert_impulse_joint(agent, object, joint) }
    }

    /// Releases the object.
    pub(crate) fn remove(self, engine: &mut PhysicsWorld) {
        engine.remove_impulse_joint(self.joint);
    }
}
