//! Weights at rest: named tensors of 32-bit floats in a safetensors file, with one entry of text that says what they are.
//!
//! [`write()`] makes such a file, [`TensorFile`] looks into one, [`TensorsError`] says what is wrong with it.
//!
//! The key design decision is that there is one kind of number and one entry of metadata: it is all that our networks and
//! their trainings need, more entries would stand in a file in an order that changes from run to run, and so the same
//! tensors are always the same bytes. The price is that files of others with other numbers are refused. Nothing here knows
//! any network, so that who evaluates one in plain Rust and who trains one in a library share it.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod error;
mod file;

pub use error::TensorsError;
pub use file::{NamedTensor, TensorFile, check_shape, write};
