//! One moving body: its parts in the engine and the state that the engine does not store.

use crate::{bodies, friction, friction::FrictionDirection};
use phase_model::{Action, AgentBody, Body, Entity, PhysicsConfig, Vec2};
use rapier2d::prelude::*;

/// Pose and velocity of a body in the engine.
pub(crate) type PoseAndVelocity = (Pose, RigidBodyVelocity<f32>);

/// One agent's or object's parts in the engine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DynamicBody {
    /// The entity.
    pub(crate) entity: Entity,
    /// The rigid body.
    pub(crate) body: RigidBodyHandle,
    /// Its only collider.
    pub(crate) collider: ColliderHandle,
    /// Its ground friction.
    pub(crate) friction: ImpulseJointHandle,
    /// The unbounded angle; the engine stores it only modulo a full turn (rad).
    pub(crate) angle: f32,
}

impl DynamicBody {
    /// Adds an entity to the engine, at the closest valid state to the given start.
    pub(crate) fn insert(
        engine: &mut PhysicsWorld,
        ground: RigidBodyHandle,
        physics: &PhysicsConfig,
        entity: Entity,
        start: &Body,
    ) -> Self {
        let start = bodies::sanitized(start, &physics.walls);
        let (body, collider) = bodies::insert_body(engine, physics, entity, &start);
        Self { entity, body, collider, friction: friction::insert(engine, ground, body), angle: start.angle }
    }

    /// Pose and motion of the body's origin and centre of mass, with the unbounded angle.
    #[must_use]
    pub(crate) fn state(&self, engine: &PhysicsWorld) -> Body {
        let body = &engine.bodies[self.body];
        Body {
            position: body.translation(),
            velocity: body.linvel(),
            angle: self.angle,
            angular_velocity: body.angvel(),
        }
    }

    /// Sets an agent's push or torque for the coming substep, or stops it.
    pub(crate) fn act(&self, engine: &mut PhysicsWorld, agent: &AgentBody, action: Action) {
        let body = &mut engine.bodies[self.body];
        body.reset_forces(true);
        body.reset_torques(true);
        if let Some(push) = action.push() {
            let point = *body.position() * Vec2::new(0.0, -agent.push_point_offset());
            let force = *body.rotation() * (push * agent.max_force);
            body.add_force_at_point(force, point, true);
        }
        body.add_torque(action.turn() * agent.turn_torque(), true);
        if action == Action::Stop {
            body.set_linvel(Vec2::ZERO, true);
        }
    }

    /// Sets the angular velocity to zero.
    pub(crate) fn stop_turning(&self, engine: &mut PhysicsWorld) {
        engine.bodies[self.body].set_angvel(0.0, true);
    }

    /// Sets the velocity to zero.
    pub(crate) fn stop(&self, engine: &mut PhysicsWorld) {
        engine.bodies[self.body].set_linvel(Vec2::ZERO, true);
        self.stop_turning(engine);
    }

    /// The body's pose and velocity.
    #[must_use]
    pub(crate) fn motion(&self, engine: &PhysicsWorld) -> PoseAndVelocity {
        let body = &engine.bodies[self.body];
        (*body.position(), *body.vels())
    }

    /// Restores an earlier pose and velocity.
    pub(crate) fn restore(&self, engine: &mut PhysicsWorld, (pose, velocities): PoseAndVelocity) {
        let body = &mut engine.bodies[self.body];
        body.set_position(pose, true);
        body.set_vels(velocities, true);
    }

    /// The friction direction that follows from the last substep; `before` is the motion at its start.
    #[must_use]
    pub(crate) fn corrected_direction(
        &self,
        engine: &PhysicsWorld,
        before: &PoseAndVelocity,
    ) -> FrictionDirection {
        FrictionDirection::after(engine, &engine.bodies[self.body], &before.0.rotation, self.friction)
    }

    /// Accumulates the rotation since `before` and corrects its integration error.
    ///
    /// The engine rotates a body by moving its axis along the tangent, so that instead of Δθ it has rotated
    /// by atan Δθ. The centre of mass is not affected.
    pub(crate) fn correct_turn(&mut self, engine: &mut PhysicsWorld, before: &PoseAndVelocity) {
        let body = &engine.bodies[self.body];
        let turn = turn_between(&before.0.rotation, body.rotation());
        if turn != 0.0 {
            self.angle += turn;
            let pose = pose_around(body.local_center_of_mass(), body.center_of_mass(), self.angle);
            engine.bodies[self.body].set_position(pose, true);
        }
    }

    /// Moves an origin back that bodies starting at the same point of the boundary have squeezed out of the
    /// arena.
    pub(crate) fn clamp_to_arena(&self, engine: &mut PhysicsWorld) {
        let body = &mut engine.bodies[self.body];
        let inside = bodies::inside(body.translation());
        if inside != body.translation() {
            body.set_translation(inside, true);
        }
    }
}

/// The rotation that the engine should have made where it moved from one rotation to another along the
/// tangent (rad).
pub(crate) fn turn_between(before: &Rotation, after: &Rotation) -> f32 {
    let turned = before.inverse() * *after;
    // No body rotates by a right angle along a tangent; the guard only keeps the quotient finite.
    turned.im / turned.re.max(f32::EPSILON)
}

/// The pose at an angle that has the centre of mass at `centre`.
pub(crate) fn pose_around(centre_of_mass: Vec2, centre: Vec2, angle: f32) -> Pose {
    let rotation = bodies::rotation(angle);
    Pose::from_parts(centre - rotation * centre_of_mass, rotation)
}
