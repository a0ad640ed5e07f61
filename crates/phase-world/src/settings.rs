//! Settings of rapier's solver.

use phase_model::{arena::SUBSTEP_SECONDS, physics::MAX_SPEED};
use rapier2d::prelude::{IntegrationParameters, PhysicsWorld, SpringCoefficients, Vector};

/// Share of a penetration that is corrected within one substep: ten corrections by a fifth each.
const CORRECTION: f32 = 0.893;
/// Share of a penetration that is corrected within one substep after an impact on a wall.
const IMPACT_CORRECTION: f32 = 0.75;
/// Maximum correction by which an impact separates a body from a wall (u).
const MAX_IMPACT_SEPARATION: f32 = 0.05;
/// Duration of an impact (s).
pub(crate) const IMPACT_SECONDS: f32 = 0.01 * SUBSTEP_SECONDS;
/// Sweeps over all constraints in one substep, before and again after positions have moved.
const SOLVER_PASSES: usize = 10;
/// Damping ratio at which contacts are no longer compliant.
const DAMPING_RATIO: f32 = 1.0e4;

/// An empty engine without gravity, with the solver settings of this crate.
///
/// One solver iteration of many sweeps: rapier spreads forces over its iterations, so that with more of them
/// a pushed body would move less far. No warm starting and no recycled contacts: only poses and velocities
/// are carried over from one substep to the next. The engine's own continuous collision detection is off,
/// because it leaves a body where it first comes near a wall and drops the rest of its substep, also along
/// the wall; `impact` takes its place.
#[must_use]
pub(crate) fn engine() -> PhysicsWorld {
    let softness = rigid_contact(CORRECTION, SUBSTEP_SECONDS);
    let mut integration_parameters = IntegrationParameters {
        dt: SUBSTEP_SECONDS,
        num_solver_iterations: 1,
        contact_softness: softness,
        static_contact_softness: softness,
        normalized_max_corrective_velocity: MAX_SPEED,
        normalized_max_linear_velocity: MAX_SPEED,
        warmstart_coefficient: 0.0,
        warmstart_joints: false,
        contact_recycling: false,
        max_ccd_substeps: 0,
        ..IntegrationParameters::default()
    };
    set_passes(&mut integration_parameters, SOLVER_PASSES);
    PhysicsWorld { gravity: Vector::ZERO, integration_parameters, ..PhysicsWorld::default() }
}

/// Sets the number of sweeps over all constraints in a substep.
pub(crate) fn set_passes(parameters: &mut IntegrationParameters, passes: usize) {
    parameters.num_internal_pgs_iterations = passes;
    parameters.num_internal_stabilization_iterations = passes;
}

/// An empty engine for impacts, whose step is so short that overlaps are resolved and velocities into walls
/// removed, but little else happens.
#[must_use]
pub(crate) fn impact_engine() -> PhysicsWorld {
    let mut engine = engine();
    let softness = rigid_contact(IMPACT_CORRECTION, IMPACT_SECONDS);
    let parameters = &mut engine.integration_parameters;
    parameters.dt = IMPACT_SECONDS;
    parameters.contact_softness = softness;
    parameters.static_contact_softness = softness;
    parameters.normalized_max_corrective_velocity = MAX_IMPACT_SEPARATION / IMPACT_SECONDS;
    parameters.normalized_max_linear_velocity = MAX_SPEED + MAX_IMPACT_SEPARATION / IMPACT_SECONDS;
    engine
}

/// A contact spring that corrects a share of a penetration within `dt` seconds and is rigid otherwise.
fn rigid_contact(correction: f32, dt: f32) -> SpringCoefficients<f32> {
    // The share corrected is dt ω / (dt ω + 2 ζ); solved for ω.
    let angular_frequency = 2.0 * DAMPING_RATIO * correction / (1.0 - correction) / dt;
    SpringCoefficients {
        natural_frequency: angular_frequency / (2.0 * core::f32::consts::PI),
        damping_ratio: DAMPING_RATIO,
    }
}
