//! Bodies as rows of numbers.

use crate::error::raise;
use phase_model::Body;
use pyo3::PyResult;

/// Columns of a body in an array: `x`, `y` (u), `angle` (rad), `vx`, `vy` (u/s), `angular_velocity` (rad/s).
pub(crate) const BODY_COLUMNS: usize = 6;

/// The row of a body.
pub(crate) const fn row_of(body: &Body) -> [f32; BODY_COLUMNS] {
    let Body { position, angle, velocity, angular_velocity } = *body;
    [position.x, position.y, angle, velocity.x, velocity.y, angular_velocity]
}

/// Checks the shape of an array.
///
/// # Errors
/// `PhaseError` that names the array and both shapes.
pub(crate) fn check_shape(name: &str, found: &[usize], expected: &[usize]) -> PyResult<()> {
    if found == expected {
        return Ok(());
    }
    Err(raise(format!("{name} must have the shape {expected:?}, not {found:?}")))
}
