//! Arrays at the door: shapes, memory order, and bodies as rows of numbers.

use crate::error::raise;
use numpy::{
    Element, Ix1, Ix2, PyArray, PyArrayMethods, PyReadonlyArray, PyReadwriteArray, PyUntypedArrayMethods,
    ndarray::{ArrayView, ArrayViewMut, Dimension},
};
use phase_model::Body;
use pyo3::{Bound, PyResult};
use std::borrow::Cow;

/// Columns of a body in an array: `x`, `y` (u), `angle` (rad), `vx`, `vy` (u/s), `angular_velocity` (rad/s).
pub(crate) const BODY_COLUMNS: usize = 6;

/// The row of a body.
pub(crate) const fn row_of(body: &Body) -> [f32; BODY_COLUMNS] {
    let Body { position, angle, velocity, angular_velocity } = *body;
    [position.x, position.y, angle, velocity.x, velocity.y, angular_velocity]
}

/// An array to read, of one shape.
///
/// # Errors
/// `PhaseError` that names the array and both shapes, and for an array that is being written to.
pub(crate) fn reading<'py, T: Element, D: Dimension>(
    name: &str,
    array: &Bound<'py, PyArray<T, D>>,
    shape: &[usize],
) -> PyResult<PyReadonlyArray<'py, T, D>> {
    check_shape(name, array.shape(), shape)?;
    array.try_readonly().map_err(|error| raise(format!("{name}: {error}")))
}

/// An array to write to, of one shape.
///
/// # Errors
/// `PhaseError` that names the array, for another shape, and for an array that is read-only or in use.
pub(crate) fn writing<'py, T: Element, D: Dimension>(
    name: &str,
    array: &Bound<'py, PyArray<T, D>>,
    shape: &[usize],
) -> PyResult<PyReadwriteArray<'py, T, D>> {
    check_shape(name, array.shape(), shape)?;
    array.try_readwrite().map_err(|error| raise(format!("{name}: {error}")))
}

/// The numbers of an array to write to, row by row, whatever the order of its memory: in another, such as
/// Fortran's, they are written beside it first.
pub(crate) struct Target<'a, T: Copy, D: Dimension> {
    array: ArrayViewMut<'a, T, D>,
    beside: Option<Vec<T>>,
}

impl<'a, T: Copy, D: Dimension> Target<'a, T, D> {
    pub(crate) fn new(array: ArrayViewMut<'a, T, D>) -> Self {
        let beside = (!array.is_standard_layout()).then(|| array.iter().copied().collect());
        Self { array, beside }
    }

    pub(crate) fn numbers(&mut self) -> &mut [T] {
        match &mut self.beside {
            Some(beside) => beside,
            None => self.array.as_slice_mut().unwrap_or_default(),
        }
    }
}

impl<T: Copy, D: Dimension> Drop for Target<'_, T, D> {
    fn drop(&mut self) {
        if let Some(beside) = &self.beside {
            self.array.iter_mut().zip(beside).for_each(|(to, from)| *to = *from);
        }
    }
}

/// The numbers of a vector, whatever its memory order.
pub(crate) fn numbers<'a>(array: &'a PyReadonlyArray<'_, f32, Ix1>) -> Cow<'a, [f32]> {
    row_by_row(array.as_array())
}

/// The numbers of a matrix, row by row, whatever its memory order.
pub(crate) fn rows<'a>(array: &'a PyReadonlyArray<'_, f32, Ix2>) -> Cow<'a, [f32]> {
    row_by_row(array.as_array())
}

fn row_by_row<D: Dimension>(array: ArrayView<'_, f32, D>) -> Cow<'_, [f32]> {
    // `to_slice` is only there for the order row by row.
    array.to_slice().map_or_else(|| Cow::Owned(array.iter().copied().collect()), Cow::Borrowed)
}

/// Checks the shape of an array.
fn check_shape(name: &str, found: &[usize], expected: &[usize]) -> PyResult<()> {
    if found == expected {
        return Ok(());
    }
    Err(raise(format!("{name} must have the shape {expected:?}, not {found:?}")))
}
