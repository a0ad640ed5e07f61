//! The neural baselines as methods to be measured.
//!
//! Their library takes minutes to build, so they are there only in a build with the feature `networks`, which is
//! `cargo xtask-networks`; every other build knows their names and goes on there when one is asked for.

/// The networks for goals and relations.
pub const RECOGNISING: [&str; 2] = ["two-level-lstm", "arg"];
/// Those for trajectories.
pub const FORECASTING: [&str; 2] = ["social-lstm", "stgat"];

#[cfg(not(feature = "networks"))]
mod absent;
#[cfg(feature = "networks")]
mod learnt;

#[cfg(not(feature = "networks"))]
pub use absent::{forecaster, or_elsewhere, recogniser, training, training_of};
#[cfg(feature = "networks")]
pub use learnt::{forecaster, or_elsewhere, recogniser, training, training_of};
