//! Q(f | S): the distribution of an agent's strength given a time window of motion.
//!
//! [`UniformStrength`] is uninformative; [`StrengthRegressor`] is the paper's network, whose weights
//! `phase-baselines` trains.

mod features;
mod file;
mod regressor;
mod weights;

pub use features::{FEATURES, features};
pub use file::STRENGTH_FORMAT;
pub use regressor::StrengthRegressor;
pub use weights::{Dense, Weights, WeightsError};

use phase_model::{AgentId, Body, MAX_ENTITIES, Size, Strength};

/// A proposal distribution over strengths.
pub trait StrengthCue: Sync {
    /// ln Q(f | S) of each level for an agent of a size, from the rows of a time window. The probabilities
    /// sum to 1.
    fn log_proposal(
        &self,
        rows: &[[Body; MAX_ENTITIES]],
        agent: AgentId,
        size: Size,
    ) -> [f64; Strength::ALL.len()];
}

/// The uninformative cue: all strengths are equally likely.
#[derive(Clone, Copy, Debug, Default)]
pub struct UniformStrength;

impl StrengthCue for UniformStrength {
    fn log_proposal(
        &self,
        _rows: &[[Body; MAX_ENTITIES]],
        _agent: AgentId,
        _size: Size,
    ) -> [f64; Strength::ALL.len()] {
        [-libm::log(Strength::ALL.len() as f64); Strength::ALL.len()]
    }
}
