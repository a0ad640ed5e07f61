//! Golden values: the results for one seed, pinned bit for bit by the ordinary tests.
//!
//! A test of any crate builds a [`Golden`] table from names and SHA-256 digests over raw bits ([`Digest`])
//! and compares it with a text file next to it. [`fixtures`] contains physical scenes and seeded random
//! actions, so that both engines are pinned on the same inputs.
//!
//! Key design decision: a digest covers the bits of every number, not its text or its memory layout: names
//! and types may change, results may not. The trade-off is that a digest shows *that* something changed, not
//! what; tables therefore have a line for each part.
//!
//! Tests use this crate, and its program runs them: `cargo xtask golden --bless` rewrites the files and
//! prints what changed.
//!
//! ```
//! use phase_golden::{Digest, fixtures};
//!
//! let (physics, state) = &fixtures::scenes()[0];
//! let mut digest = Digest::new();
//! digest.state(physics, state);
//! assert_eq!(digest.hex().len(), 64);
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

#[cfg(feature = "command")]
pub mod command;
pub mod digest;
pub mod fixtures;
pub mod table;

pub use digest::Digest;
pub use table::{BLESS, Golden};
