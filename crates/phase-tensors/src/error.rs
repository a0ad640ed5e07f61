//! Errors of files of tensors.

use safetensors::SafeTensorError;
use thiserror::Error;

/// Why bytes are not the file they should be.
#[derive(Debug, Error)]
pub enum TensorsError {
    /// The bytes are something else.
    #[error("is not a safetensors file: {0}")]
    Container(#[from] SafeTensorError),
    /// It is a file of tensors, but of another kind.
    #[error("field `{field}` must be {expected:?}")]
    Kind {
        /// The entry of its metadata.
        field: &'static str,
        /// The value it must have.
        expected: String,
    },
    /// A tensor is missing.
    #[error("tensor `{0}` is missing")]
    Missing(String),
    /// A tensor is not one of those expected.
    #[error("tensor `{0}` does not belong there")]
    Unknown(String),
    /// A tensor holds another type of numbers.
    #[error("tensor `{0}` must hold 32-bit floats")]
    Type(String),
    /// A tensor has another shape than it must have.
    #[error("tensor `{name}` must have the shape {expected:?}, not {found:?}")]
    Shape {
        /// The tensor.
        name: String,
        /// The dimensions that it must have.
        expected: Vec<usize>,
        /// The dimensions that it has.
        found: Vec<usize>,
    },
    /// A value is not finite.
    #[error("tensor `{0}` must hold finite numbers")]
    NotFinite(String),
}
