//! The errors with which rows say where bodies were.

use phase_event::Noise;
use phase_model::{AGENT_COUNT, MAX_ENTITIES};

/// Least error of a position that was read from a picture (u): what fits of shapes do not show.
const LEAST: f32 = 0.008;
/// Share of a difference from the observed position by which a state is corrected if rows are noisy, and the
/// share of a step's length of it by which its velocity is.
pub(super) const GAIN: f32 = 0.6;
pub(super) const VELOCITY_GAIN: f32 = 0.3;

/// The expected residual of a step that is explained exactly (u): 0 for exact rows.
pub(super) fn expected_residual(noise: Option<Noise>, radii: &[f32; MAX_ENTITIES]) -> f32 {
    let Some(noise) = noise else { return 0.0 };
    let position = noise.position.max(LEAST);
    let squares = radii.iter().enumerate().filter(|(_, radius)| **radius > 0.0).map(|(body, radius)| {
        let turn = if body < AGENT_COUNT { noise.angle * radius } else { 0.0 };
        2.0 * position * position + turn * turn
    });
    squares.sum::<f32>().sqrt()
}
