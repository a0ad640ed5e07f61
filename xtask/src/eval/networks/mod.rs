//! The neural baselines as methods to be measured.
//!
//! Their library takes minutes to build, so they are there only in a build with the feature `networks`, which is
//! `cargo xtask-networks`; every other build knows their names and goes on there when one is asked for.

#[cfg(not(feature = "networks"))]
mod absent;
#[cfg(feature = "networks")]
mod learnt;

#[cfg(not(feature = "networks"))]
pub use absent::{forecaster, or_elsewhere, recogniser, training, training_of};
#[cfg(feature = "networks")]
pub use learnt::{forecaster, or_elsewhere, recogniser, training, training_of};
