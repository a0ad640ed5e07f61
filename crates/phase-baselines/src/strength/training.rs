//! Training the strength regressor: Adam on the squared error, until the error on validation events stops
//! improving.

use super::{
    AgentSamples, Sample, most_common,
    network::{Network, Standardisation},
    score,
};
use candle_nn::{AdamW, Optimizer, ParamsAdamW};
use phase_model::random::{self, Pcg64Mcg, Purpose};
use phase_simple::{StrengthRegressor, strength::WeightsError};
use rand::{RngExt, seq::SliceRandom};
use thiserror::Error;

/// Settings of the training. The paper gives the hidden layers' size; the rest is standard.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct StrengthTrainingSettings {
    /// Size of both hidden layers, at least 1.
    pub hidden: usize,
    /// Batch size (samples), at least 1.
    pub batch: usize,
    /// Adam's learning rate.
    pub learning_rate: f64,
    /// Windows drawn from each agent's motion in each epoch, beside the whole of it.
    pub windows: usize,
    /// Epochs without progress on the validation events after which training ends.
    pub patience: usize,
    /// Maximum number of epochs, at least 1.
    pub epochs: usize,
}

impl Default for StrengthTrainingSettings {
    fn default() -> Self {
        Self { hidden: 64, batch: 64, learning_rate: 1e-3, windows: 4, patience: 30, epochs: 500 }
    }
}

/// Progress of training. All errors are root mean squared, in N.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Epoch {
    /// The epoch, from 1.
    pub number: usize,
    /// On the epoch's training samples, during training.
    pub training: f64,
    /// On whole validation events.
    pub whole: f64,
    /// On all windows of validation events.
    pub windows: f64,
    /// Over both with equal weight: the criterion to minimise.
    pub validation: f64,
    /// Whether it is the best so far.
    pub best: bool,
}

/// Why training fails.
#[derive(Debug, Error)]
pub enum TrainingError {
    /// There are no training or no validation samples.
    #[error("there are no {0} events to learn strengths from")]
    NoMotion(&'static str),
    /// The neural-network library failed.
    #[error("the network cannot be trained: {0}")]
    Network(#[from] candle_core::Error),
    /// Training diverged.
    #[error("training diverged in epoch {epoch}: {source}")]
    Diverged {
        /// The epoch, from 1.
        epoch: usize,
        /// The rule that the weights break.
        source: WeightsError,
    },
}

/// Trains a regressor; the weights are those of the best epoch. The same seed and motion give the same
/// weights. `on_epoch` is called after every epoch.
///
/// # Errors
/// [`TrainingError`].
pub fn train(
    training: &[AgentSamples],
    validation: &[AgentSamples],
    seed: u64,
    settings: &StrengthTrainingSettings,
    on_epoch: &mut dyn FnMut(&Epoch),
) -> Result<StrengthRegressor, TrainingError> {
    for (name, motions) in [("training", training), ("validation", validation)] {
        if motions.is_empty() {
            return Err(TrainingError::NoMotion(name));
        }
    }
    let standard =
        Standardisation::of(training.iter().flat_map(|motion| motion.windows.iter().chain([&motion.whole])));
    let network = Network::new(settings.hidden.max(1), &mut random::stream(seed, Purpose::Training, 0))?;
    // Without weight decay, AdamW is Adam.
    let adam = ParamsAdamW { lr: settings.learning_rate, weight_decay: 0.0, ..ParamsAdamW::default() };
    let mut optimiser = AdamW::new(network.variables(), adam)?;
    let mut best: Option<(f64, usize, StrengthRegressor)> = None;
    for number in 1..=settings.epochs.max(1) {
        let mut random = random::stream(seed, Purpose::Training, number as u64);
        let samples = sample_rows(training, settings.windows, &mut random);
        let mut squares = 0.0;
        for batch in samples.chunks(settings.batch.max(1)) {
            let loss = network.loss(batch, &standard)?;
            optimiser.backward_step(&loss)?;
            squares += f64::from(loss.to_scalar::<f32>()?) * batch.len() as f64;
        }
        let apart = |source| TrainingError::Diverged { epoch: number, source };
        let mut weights = network.weights(&standard)?;
        let regressor = StrengthRegressor::new(weights.clone()).map_err(apart)?;
        let (whole, windows) = validated(&regressor, validation);
        let error = (0.5 * (whole * whole + windows * windows)).sqrt();
        let better = best.as_ref().is_none_or(|(least, _, _)| error < *least);
        on_epoch(&Epoch {
            number,
            training: (squares / samples.len() as f64).sqrt() * standard.force_deviation(),
            whole,
            windows,
            validation: error,
            best: better,
        });
        if better {
            weights.rmse = error as f32;
            best = Some((error, number, StrengthRegressor::new(weights).map_err(apart)?));
        } else if best.as_ref().is_some_and(|(_, then, _)| number - then >= settings.patience) {
            break;
        }
    }
    best.map(|(_, _, regressor)| regressor).ok_or(TrainingError::NoMotion("training"))
}

/// The samples of an epoch: each motion as a whole and some windows of it, in random order.
fn sample_rows(motions: &[AgentSamples], windows: usize, random: &mut Pcg64Mcg) -> Vec<Sample> {
    let mut samples = Vec::with_capacity(motions.len() * (1 + windows));
    for motion in motions {
        samples.push(motion.whole);
        for _ in 0..windows {
            samples.extend(motion.windows.get(random.random_range(0..motion.windows.len().max(1))));
        }
    }
    samples.shuffle(random);
    samples
}

/// Errors on whole motions and on windows (N).
fn validated(regressor: &StrengthRegressor, motions: &[AgentSamples]) -> (f64, f64) {
    let guess = most_common(motions.iter().map(|motion| &motion.whole));
    let whole = motions.iter().map(|motion| core::slice::from_ref(&motion.whole));
    let windows = motions.iter().map(|motion| &*motion.windows);
    (score(regressor, whole, guess).rmse, score(regressor, windows, guess).rmse)
}
