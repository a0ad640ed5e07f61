//! Deviation of a state from a recorded one.

use phase_model::{
    AGENT_COUNT, AgentId, Body, MAX_ENTITIES, ObjectId, PhysicsConfig, State, Vec2, arena::SUBSTEPS,
};
use serde::Serialize;

/// The largest errors over all bodies at one moment. Infinite where a value is NaN.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize)]
pub struct Deviation {
    /// Distance between positions (u).
    pub position: f32,
    /// Difference of angles, unbounded as angles are (rad).
    pub angle: f32,
}

impl Deviation {
    /// Between the bodies present in a scene.
    #[must_use]
    pub fn between(
        physics: &PhysicsConfig,
        found: &[Body; MAX_ENTITIES],
        recorded: &[Body; MAX_ENTITIES],
    ) -> Self {
        let pairs = found.iter().zip(recorded).take(physics.entity_count());
        pairs.fold(Self::default(), |worst, (found, recorded)| Self {
            position: worst.position.max(finite(found.position.distance(recorded.position))),
            angle: worst.angle.max(finite((found.angle - recorded.angle).abs())),
        })
    }
}

/// The mean over the substeps of a step of position, velocity, angle and angular velocity.
pub(crate) fn mean(substeps: &[State; SUBSTEPS]) -> [Body; MAX_ENTITIES] {
    let share = 1.0 / SUBSTEPS as f32;
    core::array::from_fn(|entity| {
        let bodies = substeps.iter().map(|state| state.bodies[entity]);
        let sum = bodies.fold(Body::default(), |sum, body| Body {
            position: sum.position + body.position,
            velocity: sum.velocity + body.velocity,
            angle: sum.angle + body.angle,
            angular_velocity: sum.angular_velocity + body.angular_velocity,
        });
        Body {
            position: sum.position * share,
            velocity: sum.velocity * share,
            angle: sum.angle * share,
            angular_velocity: sum.angular_velocity * share,
        }
    })
}

/// Object that each agent holds.
pub(crate) fn held(state: &State) -> [Option<ObjectId>; AGENT_COUNT] {
    AgentId::ALL.map(|agent| state.held_object(agent))
}

/// `f32::max` ignores NaN, which must not make an error disappear.
fn finite(error: f32) -> f32 {
    if error.is_nan() { f32::INFINITY } else { error }
}

/// A body from x, y, vx, vy, angle and angular velocity.
pub(crate) fn body([x, y, vx, vy, angle, angular_velocity]: [f32; 6]) -> Body {
    Body { position: Vec2::new(x, y), velocity: Vec2::new(vx, vy), angle, angular_velocity }
}
