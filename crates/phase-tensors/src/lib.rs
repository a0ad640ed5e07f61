//! Weights on disk: named 32-bit float tensors in a safetensors file, with one metadata entry that identifies
//! them.
//!
//! [`write()`] makes such a file, [`TensorFile`] reads one, [`TensorsError`] describes what is wrong with it.
//!
//! Key design decision: there is one numeric type and one metadata entry. PHASE's networks and their training
//! need no more, and further entries would be stored in an order that changes from run to run; so the same
//! tensors always give the same bytes. The trade-off is that files with other numeric types are rejected.
//! Nothing here depends on a particular network, so evaluation in plain Rust and training in a library share
//! it.
//!
//! Two numbers are written and read again. By the safetensors format they are the last bytes of the file,
//! little-endian:
//!
//! ```
//! use phase_tensors::{NamedTensor, TensorFile, TensorsError, write};
//!
//! let bias = NamedTensor { name: "output.bias".into(), shape: vec![2], values: vec![0.5, -1.0] };
//! let bytes = write(&[bias], "format", "example-weights/1")?;
//! assert!(bytes.ends_with(&[0, 0, 0, 0x3f, 0, 0, 0x80, 0xbf])); // IEEE 754
//!
//! let file = TensorFile::open_as(&bytes, "format", "example-weights/1")?;
//! assert_eq!(file.values("output.bias", &[2])?, [0.5, -1.0]);
//! let missing = file.values("output.weight", &[2]);
//! assert!(matches!(missing, Err(TensorsError::Missing(name)) if name == "output.weight"));
//! # Ok::<(), TensorsError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod choice;
mod dense;
mod error;
mod file;

pub use choice::ChoiceNetwork;
pub use dense::{Dense, relu, vector};
pub use error::TensorsError;
pub use file::{NamedTensor, TensorFile, check_shape, write};
