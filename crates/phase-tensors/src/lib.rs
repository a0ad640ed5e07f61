//! Weights at rest: named tensors of 32-bit floats in a safetensors file, with one entry of text that says what they are.
//!
//! [`write()`] makes such a file, [`TensorFile`] looks into one, [`TensorsError`] says what is wrong with it.
//!
//! The key design decision is that there is one kind of number and one entry of metadata: it is all that our networks and
//! their trainings need, more entries would stand in a file in an order that changes from run to run, and so the same
//! tensors are always the same bytes. The price is that files of others with other numbers are refused. Nothing here knows
//! any network, so that who evaluates one in plain Rust and who trains one in a library share it.
//!
//! Two numbers are written and read again. By the safetensors format they are the last bytes of the file, little-endian:
//!
//! ```
//! use phase_tensors::{NamedTensor, TensorFile, TensorsError, write};
//!
//! let bias = NamedTensor { name: "output.bias".into(), shape: vec![2], numbers: vec![0.5, -1.0] };
//! let bytes = write(&[bias], "format", "example-weights/1")?;
//! assert!(bytes.ends_with(&[0, 0, 0, 0x3f, 0, 0, 0x80, 0xbf])); // IEEE 754
//!
//! let file = TensorFile::open_kind(&bytes, "format", "example-weights/1")?;
//! assert_eq!(file.numbers("output.bias", &[2])?, [0.5, -1.0]);
//! assert!(matches!(file.numbers("output.weight", &[2]), Err(TensorsError::Missing(name)) if name == "output.weight"));
//! # Ok::<(), TensorsError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod error;
mod file;

pub use error::TensorsError;
pub use file::{NamedTensor, TensorFile, check_shape, write};
