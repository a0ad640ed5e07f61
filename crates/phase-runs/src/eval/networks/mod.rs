//! The neural baselines as methods to be evaluated.
//!
//! Their library takes minutes to build, so they are only available in a build with the feature `networks`;
//! every other build knows their names and reports what to use instead.

/// Whether this build has networks.
pub const INCLUDED: bool = cfg!(feature = "networks");

/// The networks for goals and relations.
pub(crate) const RECOGNISING: [&str; 3] = ["two-level-lstm", "arg", "socialgnn"];
/// Those for trajectories.
pub(crate) const FORECASTING: [&str; 2] = ["social-lstm", "stgat"];

/// That for beliefs.
pub(crate) const READING: &str = "belief-network";

/// Whether a method is a neural network.
#[must_use]
pub fn is_network(method: &str) -> bool {
    RECOGNISING.iter().chain(&FORECASTING).chain([&READING]).any(|name| *name == method)
}

#[cfg(not(feature = "networks"))]
mod absent;
#[cfg(feature = "networks")]
mod trained;

#[cfg(not(feature = "networks"))]
pub(crate) use absent::{belief_reader, forecaster, recogniser, training, training_of};
#[cfg(feature = "networks")]
pub(crate) use trained::{belief_reader, forecaster, recogniser, training, training_of};
