//! The difference between a predicted body and the observed one.

use super::{
    interpolation::SUBSTEPS_TO_END,
    noise::{GAIN, VELOCITY_GAIN},
};
use phase_model::{
    Body, MAX_ENTITIES, State, Vec2,
    arena::{STEP_SECONDS, SUBSTEP_SECONDS, SUBSTEPS},
};

/// The correction from a predicted body to the observed one, as means over a step.
#[derive(Clone, Copy, Default, Debug)]
pub(super) struct Difference {
    pub(super) position: Vec2,
    pub(super) velocity: Vec2,
    pub(super) angle: f32,
}

impl Difference {
    /// Angles are compared modulo a period (rad), or not at all.
    pub(super) fn between(predicted: &Body, observed: &Body, angle_period: Option<f32>) -> Self {
        let turned = observed.angle - predicted.angle;
        Self {
            position: observed.position - predicted.position,
            velocity: observed.velocity - predicted.velocity,
            angle: angle_period.map_or(0.0, |period| libm::remainderf(turned, period)),
        }
    }

    /// Squared magnitude (u²): velocities, if they were measured, are weighted by the distance covered in a
    /// step, angles by the motion of the rim.
    pub(super) fn square(&self, radius: f32, velocities: bool) -> f32 {
        let turned = self.angle * radius;
        let moved = if velocities { self.velocity * STEP_SECONDS as f32 } else { Vec2::ZERO };
        self.position.length_squared() + moved.length_squared() + turned * turned
    }

    /// The body at the end of the step, corrected by a part of what a noisy row says.
    pub(super) fn partly_added_to(&self, body: &Body) -> Body {
        Body {
            position: body.position + self.position * GAIN,
            velocity: body.velocity + self.position * (VELOCITY_GAIN / STEP_SECONDS as f32),
            angle: body.angle + self.angle * GAIN,
            angular_velocity: body.angular_velocity,
        }
    }

    /// The body at the end of the step, corrected.
    pub(super) fn added_to(&self, body: &Body) -> Body {
        let since_mean = SUBSTEPS_TO_END * SUBSTEP_SECONDS;
        Body {
            position: body.position + self.position + self.velocity * since_mean,
            velocity: body.velocity + self.velocity,
            angle: body.angle + self.angle,
            angular_velocity: body.angular_velocity,
        }
    }

    /// The means of all bodies over a step, as rows have them.
    pub(super) fn means(substeps: &[State; SUBSTEPS]) -> [Body; MAX_ENTITIES] {
        let mut means = [Body::default(); MAX_ENTITIES];
        for substep in substeps {
            for (mean, body) in means.iter_mut().zip(&substep.bodies) {
                mean.position += body.position / SUBSTEPS as f32;
                mean.velocity += body.velocity / SUBSTEPS as f32;
                mean.angle += body.angle / SUBSTEPS as f32;
            }
        }
        means
    }
}
