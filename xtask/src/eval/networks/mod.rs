//! The neural baselines as methods to be measured.
//!
//! Their library takes minutes to build, so they are there only in `cargo xtask-networks`; everywhere else their
//! names are known, and the answer is how to get them.

#[cfg(not(feature = "networks"))]
mod absent;
#[cfg(feature = "networks")]
mod learnt;

#[cfg(not(feature = "networks"))]
pub use absent::{forecaster, or_elsewhere, recogniser, training, training_of};
#[cfg(feature = "networks")]
pub use learnt::{forecaster, or_elsewhere, recogniser, training, training_of};
