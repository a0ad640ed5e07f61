//! How rapier's solver is set up.

use rapier2d::prelude::{IntegrationParameters, PhysicsWorld, SpringCoefficients, Vector};

/// Share of a penetration that is corrected within one substep.
const PENETRATION_CORRECTION: f32 = 0.893;
/// Greatest speed at which the position correction pushes bodies apart (u/s).
const MAX_CORRECTION_SPEED: f32 = 120.0;
/// Speed limit of every body (u/s).
const MAX_SPEED: f32 = 120.0;
/// Sweeps over all constraints in one substep.
const SWEEPS: usize = 10;
/// Damping ratio that makes contacts rigid.
const RIGID: f32 = 1.0e4;

/// An empty engine without gravity, with the solver settings of this crate.
#[must_use]
pub fn engine() -> PhysicsWorld {
    PhysicsWorld { gravity: Vector::ZERO, integration_parameters: parameters(), ..PhysicsWorld::default() }
}

/// .
pub fn env(name: &str, default: f32) -> f32 {
    std::env::var(name).ok().and_then(|s| s.parse().ok()).unwrap_or(default)
}

fn parameters() -> IntegrationParameters {
    let dt = phase_model::arena::SUBSTEP_SECONDS;
    let erp = env("ERP", PENETRATION_CORRECTION);
    let softness = rigid(erp, dt);
    IntegrationParameters {
        dt,
        num_solver_iterations: 1,
        num_internal_pgs_iterations: env("PGS", SWEEPS as f32) as usize,
        num_internal_stabilization_iterations: env("STAB", SWEEPS as f32) as usize,
        contact_softness: softness,
        static_contact_softness: softness,
        normalized_max_corrective_velocity: MAX_CORRECTION_SPEED,
        normalized_max_linear_velocity: MAX_SPEED,
        normalized_prediction_distance: env("PRED", 0.02),
        normalized_allowed_linear_error: 0.005,
        warmstart_coefficient: 0.0,
        warmstart_joints: false,
        contact_recycling: false,
        ..IntegrationParameters::default()
    }
}

/// A spring that corrects the given share of an error in one substep and does not give way otherwise.
fn rigid(share: f32, dt: f32) -> SpringCoefficients<f32> {
    // share = dt ω / (dt ω + 2 ζ), solved for ω.
    let angular_frequency = 2.0 * RIGID * share / (1.0 - share) / dt;
    SpringCoefficients {
        natural_frequency: angular_frequency / (2.0 * core::f32::consts::PI),
        damping_ratio: RIGID,
    }
}
