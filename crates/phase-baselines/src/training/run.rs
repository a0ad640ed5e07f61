//! The training loop.

use super::{Loss, Network, adam::Adam, order};
use crate::parameters;
use candle_core::Result;
use phase_model::random::{self, Pcg64Mcg, Purpose};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Training settings. Rounds have a fixed size whatever the number of events, so that a number of rounds is
/// the same amount of work, and patience has the same meaning, for every dataset.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrainingSettings {
    /// Batch size (events), at least 1.
    pub batch: usize,
    /// Adam's learning rate.
    pub learning_rate: f64,
    /// Maximum global norm of the gradients; larger ones are scaled down to it.
    #[serde(rename = "longest_slope")]
    pub max_gradient_norm: f64,
    /// Events in a round, at least 1. Fewer events are repeated; of more, each round takes the next part.
    pub round: usize,
    /// Rounds without progress on the validation events after which training ends.
    pub patience: usize,
    /// Maximum number of rounds, in the range [`ROUNDS`](phase_model::setting::ROUNDS).
    pub rounds: usize,
}

/// Means over some events.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Metrics {
    /// The loss.
    pub loss: f64,
    /// The other metrics, in the order of [`Network::METRICS`].
    pub scores: Vec<f64>,
}

/// One round.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Round {
    /// Its number, from 1.
    pub number: usize,
    /// On the training events, during training.
    pub training: Metrics,
    /// On the validation events afterwards; [`Network::selection_loss`] is the criterion to minimise.
    pub validation: Metrics,
    /// Whether it was the best up to then.
    pub best: bool,
}

/// Why training fails.
#[derive(Debug, Error)]
pub enum TrainingError {
    /// There are no training or no validation events.
    #[error("there are no {0} events to learn from")]
    NoEvents(&'static str),
    /// The neural-network library failed.
    #[error("the network cannot be trained: {0}")]
    Network(#[from] candle_core::Error),
    /// Training diverged.
    #[error("training diverged in round {0}: the loss is not finite")]
    Diverged(usize),
}

/// A training in progress. All randomness is derived from the seed and the number of the round or pass, so it
/// can stop after any round and resume.
#[derive(Debug)]
pub struct TrainingRun<N: Network> {
    pub(super) network: N,
    pub(super) adam: Adam,
    pub(super) seed: u64,
    pub(super) settings: TrainingSettings,
    pub(super) rounds: Vec<Round>,
    /// The weights of the best round.
    pub(super) best: Option<Vec<Vec<f32>>>,
}

impl<N: Network> TrainingRun<N> {
    /// A run before its first round, of a network with its initial weights; those are drawn from
    /// [`first_weights`](Self::first_weights).
    #[must_use]
    pub fn new(network: N, seed: u64, settings: TrainingSettings) -> Self {
        let adam = Adam::new(&network.parameters());
        Self { network, adam, seed, settings, rounds: Vec::new(), best: None }
    }

    /// The generator of the initial weights of a run.
    #[must_use]
    pub fn first_weights(seed: u64) -> Pcg64Mcg {
        random::stream(seed, Purpose::Training, 0)
    }

    /// The network as it is now.
    #[must_use]
    pub const fn network(&self) -> &N {
        &self.network
    }

    /// The rounds so far.
    #[must_use]
    pub fn rounds(&self) -> &[Round] {
        &self.rounds
    }

    /// The best round so far.
    #[must_use]
    pub fn best_round(&self) -> Option<&Round> {
        self.rounds.iter().rfind(|round| round.best)
    }

    /// Whether it has reached the maximum number of rounds or stopped improving.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        let done = self.rounds.len();
        let best = self.best_round().map_or(done, |round| round.number);
        done >= self.settings.rounds || done - best >= self.settings.patience.max(1)
    }

    /// Trains on the next events of an endless sequence of shuffled passes, then evaluates on the validation
    /// events.
    ///
    /// # Errors
    /// [`TrainingError`].
    pub fn round(
        &mut self,
        training: &[N::Sample],
        validation: &[N::Sample],
    ) -> core::result::Result<&Round, TrainingError> {
        for (name, samples) in [("training", training), ("validation", validation)] {
            if samples.is_empty() {
                return Err(TrainingError::NoEvents(name));
            }
        }
        let number = self.rounds.len() + 1;
        let mut random = order::random_of_round(self.seed, number);
        let order = order::samples(training, self.seed, number, self.settings.round.max(1));
        let parameters = self.network.parameters();
        let mut learnt = Mean::default();
        for batch in order.chunks(self.settings.batch.max(1)) {
            let loss = self.network.loss(batch, Some(&mut random))?;
            learnt.add(&loss, batch.len())?;
            let TrainingSettings { learning_rate, max_gradient_norm, .. } = self.settings;
            self.adam.step(&parameters, &loss.loss.backward()?, learning_rate, max_gradient_norm)?;
        }
        let training = learnt.evaluate();
        let validation = evaluate(&self.network, validation, self.settings.batch)?;
        if !(training.loss.is_finite() && validation.loss.is_finite()) {
            return Err(TrainingError::Diverged(number));
        }
        let short = N::selection_loss(&validation);
        let best = self.best_round().is_none_or(|round| short < N::selection_loss(&round.validation));
        if best {
            self.best = Some(parameters::values(&parameters)?);
        }
        self.rounds.push(Round { number, training, validation, best });
        self.rounds.last().ok_or(TrainingError::NoEvents("training"))
    }

    /// The network with the weights of its best round, or its initial ones.
    ///
    /// # Errors
    ///
    /// If they cannot be restored.
    pub fn into_best(self) -> Result<N> {
        if let Some(best) = &self.best {
            parameters::set_values(&self.network.parameters(), best)?;
        }
        Ok(self.network)
    }
}

/// Metrics of a network on some samples; zeros without any.
///
/// # Errors
///
/// If a tensor cannot be allocated.
pub fn evaluate<N: Network>(network: &N, samples: &[N::Sample], batch: usize) -> Result<Metrics> {
    let mut mean = Mean::default();
    let samples: Vec<&N::Sample> = samples.iter().collect();
    for batch in samples.chunks(batch.max(1)) {
        mean.add(&network.loss(batch, None)?, batch.len())?;
    }
    Ok(mean.evaluate())
}

/// A mean over batches in which each sample has equal weight.
#[derive(Default)]
struct Mean {
    samples: f64,
    loss: f64,
    scores: Vec<f64>,
}

impl Mean {
    fn add(&mut self, loss: &Loss, samples: usize) -> Result<()> {
        let samples = samples as f64;
        self.samples += samples;
        self.loss += samples * f64::from(loss.loss.to_scalar::<f32>()?);
        self.scores.resize(loss.scores.len(), 0.0);
        self.scores.iter_mut().zip(&loss.scores).for_each(|(sum, score)| *sum += samples * score);
        Ok(())
    }

    fn evaluate(self) -> Metrics {
        let samples = self.samples.max(1.0);
        Metrics {
            loss: self.loss / samples,
            scores: self.scores.into_iter().map(|sum| sum / samples).collect(),
        }
    }
}
