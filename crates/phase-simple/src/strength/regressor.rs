//! The paper's estimate of strengths: a network with two hidden layers (appendix, "Bottom-up Proposals").

use super::{FEATURES, StrengthCue, UniformStrength, Weights, WeightsError, features};
use phase_model::{AgentId, Body, MAX_ENTITIES, Size, Strength};
use phase_statistics::log_softmax;
use phase_tensors::relu;

/// Estimates an agent's maximum force from its speeds and accelerations.
///
/// The network is evaluated here, in a fixed order and in double precision, so a proposal needs no
/// neural-network library and is the same everywhere, bit for bit.
#[derive(Clone, PartialEq, Debug)]
pub struct StrengthRegressor {
    weights: Weights,
}

/// The weights trained by `cargo train strength`; `docs/explanation/networks.md` describes the training data.
const BUNDLED_WEIGHTS: &[u8] = phase_data::STRENGTH_WEIGHTS;

/// The mean of the levels (N).
const MEAN_FORCE: f64 = 0.5 * (Strength::Weak.max_force() + Strength::Mighty.max_force()) as f64;

impl StrengthRegressor {
    /// The regressor that comes with the program, trained on the training events of a PHASE-500 dataset.
    ///
    /// # Errors
    /// [`WeightsError`] if the program was built with a damaged file.
    pub fn bundled() -> Result<Self, WeightsError> {
        Self::from_safetensors(BUNDLED_WEIGHTS)
    }

    /// A regressor of these weights.
    ///
    /// # Errors
    /// [`WeightsError`] for layers that do not match each other and for values that are not valid.
    pub fn new(weights: Weights) -> Result<Self, WeightsError> {
        weights.check()?;
        Ok(Self { weights })
    }

    /// Its weights.
    #[must_use]
    pub const fn weights(&self) -> &Weights {
        &self.weights
    }

    /// The maximum force (N) of an agent of a size, estimated from the rows of a time window. The estimate
    /// may lie between the levels, or beyond them for motion unlike the training data.
    #[must_use]
    pub fn estimate(&self, rows: &[[Body; MAX_ENTITIES]], agent: AgentId, size: Size) -> f32 {
        self.estimate_from(&features(rows, agent, size)) as f32
    }

    /// The maximum force (N) of an agent with these [`features`], in double precision.
    #[must_use]
    pub fn estimate_from(&self, features: &[f64; FEATURES]) -> f64 {
        let Weights { mean, scale, hidden: [first, second], output, .. } = &self.weights;
        let standardised = features.iter().zip(mean).zip(scale);
        let inputs: Vec<f64> = standardised
            .map(|((feature, &mean), &scale)| (feature - f64::from(mean)) / f64::from(scale))
            .collect();
        let hidden = relu(first.apply(&inputs));
        let hidden = relu(second.apply(&hidden));
        output.apply(&hidden).into_iter().sum()
    }
}

impl StrengthCue for StrengthRegressor {
    /// The levels under a normal distribution around the estimate, whose standard deviation is the error on
    /// held-out events.
    fn log_proposal(
        &self,
        rows: &[[Body; MAX_ENTITIES]],
        agent: AgentId,
        size: Size,
    ) -> [f64; Strength::ALL.len()] {
        let estimate = f64::from(self.estimate(rows, agent, size));
        if !estimate.is_finite() {
            return UniformStrength.log_proposal(rows, agent, size);
        }
        let variance = f64::from(self.weights.rmse) * f64::from(self.weights.rmse);
        // The exponents relative to the middle one, so that no precision is lost however far off the estimate
        // is.
        let mut logs = Strength::ALL.map(|strength| {
            let force = f64::from(strength.max_force());
            (force - MEAN_FORCE) * (2.0 * estimate - force - MEAN_FORCE) / (2.0 * variance)
        });
        log_softmax(&mut logs);
        logs
    }
}
