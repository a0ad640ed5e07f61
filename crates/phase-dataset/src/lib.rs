//! PHASE events at rest.
#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod atomic;
pub mod error;
pub mod json;
pub mod phase_events;

pub use error::{FieldError, FileError, Problem, WriteError};
