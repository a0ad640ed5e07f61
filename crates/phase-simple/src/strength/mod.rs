//! Q(f | S): the distribution of an agent's strength given a time window of motion.
//!
//! [`UniformStrength`] is uninformative; [`StrengthRegressor`] is the paper's network, whose weights
//! `phase-baselines` trains; [`InferredStrengths`] are those of inverse dynamics.

mod features;
mod file;
mod regressor;
mod weights;

pub use features::{FEATURES, features};
pub use file::STRENGTH_FORMAT;
pub use regressor::StrengthRegressor;
pub use weights::{Weights, WeightsError};

use phase_model::{AGENT_COUNT, AgentId, Body, MAX_ENTITIES, Size, Strength};

/// A proposal distribution over strengths, for Algorithm 2: the guess, from motion alone, at how strong an
/// agent is.
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

/// Probability left to all strengths but the inferred one, so that none is impossible.
const DOUBT: f64 = 1e-6;

/// Strengths that follow from the physics ([`crate::InverseDynamics::strengths`]), whatever the time window.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct InferredStrengths(pub [Strength; AGENT_COUNT]);

impl StrengthCue for InferredStrengths {
    fn log_proposal(
        &self,
        _rows: &[[Body; MAX_ENTITIES]],
        agent: AgentId,
        _size: Size,
    ) -> [f64; Strength::ALL.len()] {
        let others = (Strength::ALL.len() - 1) as f64;
        Strength::ALL.map(|strength| {
            let probability = if strength == self.0[agent] { 1.0 - DOUBT } else { DOUBT / others };
            libm::log(probability)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{InferredStrengths, StrengthCue};
    use phase_model::{AgentId, Size, Strength};

    #[test]
    fn inferred_strengths_are_nearly_certain_and_sum_to_1() {
        let cue = InferredStrengths([Strength::Weak, Strength::Mighty]);
        for agent in AgentId::ALL {
            let logs = cue.log_proposal(&[], agent, Size::Small);
            assert!((logs.iter().map(|log| libm::exp(*log)).sum::<f64>() - 1.0).abs() < 1e-12);
            let place = Strength::ALL.iter().position(|it| *it == cue.0[agent]).expect("a strength");
            assert!(logs[place] > -1e-5 && logs.iter().all(|log| log.is_finite()));
        }
    }
}
