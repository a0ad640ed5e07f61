//! The exception of the package.

use pyo3::{create_exception, exceptions::PyValueError, prelude::*};
use std::fmt::Display;

create_exception!(
    phase_events,
    PhaseError,
    PyValueError,
    "Something given to PHASE is invalid, or PHASE failed. Its text is the sentence that the command line \
     prints."
);

/// An exception with the text of an error.
pub(crate) fn raise(error: impl Display) -> PyErr {
    PhaseError::new_err(error.to_string())
}

/// As [`raise`], with the exit code of the command line in the attribute `exit_code`.
pub(crate) fn raise_with_code(error: impl Display, exit_code: u8) -> PyErr {
    let error = raise(error);
    // Without the attribute the exception says the same.
    let _ = Python::attach(|py| error.value(py).setattr("exit_code", exit_code));
    error
}
