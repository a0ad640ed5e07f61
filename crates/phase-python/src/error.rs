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
