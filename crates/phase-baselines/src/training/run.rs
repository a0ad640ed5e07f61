//! The loop itself.

use super::{Loss, Network, adam::Adam};
use crate::parameters;
use candle_core::Result;
use phase_model::random::{self, Pcg64Mcg, Purpose};
use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// How to train.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Settings {
    /// Events between two changes of the weights, at least 1.
    pub batch: usize,
    /// Adam's rate of learning.
    pub learning_rate: f64,
    /// Greatest length of the slope of all weights together; longer ones are shortened to it.
    pub longest_slope: f64,
    /// Epochs without any progress on the validation events after which training ends.
    pub patience: usize,
    /// Epochs at most.
    pub epochs: usize,
}

/// Means over some events.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Measure {
    /// The loss.
    pub loss: f64,
    /// What else is measured, in the order of [`Network::SCORES`].
    pub scores: Vec<f64>,
}

/// One epoch.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Epoch {
    /// Its number, from 1.
    pub number: usize,
    /// On the training events while they were learnt from.
    pub training: Measure,
    /// On the validation events afterwards; [`Network::shortcoming`] is what has to become less.
    pub validation: Measure,
    /// Whether it was the best up to then.
    pub best: bool,
}

/// Why nothing can be learnt.
#[derive(Debug, Error)]
pub enum TrainingError {
    /// There is nothing to learn from, or to validate on.
    #[error("there are no {0} events to learn from")]
    NoEvents(&'static str),
    /// The library for neural networks gave up.
    #[error("the network cannot be trained: {0}")]
    Network(#[from] candle_core::Error),
    /// Numbers grew beyond all bounds.
    #[error("training came apart in epoch {0}: the loss is no number any more")]
    Apart(usize),
}

/// A training under way. Everything it draws comes from (seed, epoch), so it can stop after any epoch and go on later.
#[derive(Debug)]
pub struct Run<N: Network> {
    pub(super) network: N,
    pub(super) adam: Adam,
    pub(super) seed: u64,
    pub(super) settings: Settings,
    pub(super) epochs: Vec<Epoch>,
    /// The weights of the best epoch.
    pub(super) best: Option<Vec<Vec<f32>>>,
}

impl<N: Network> Run<N> {
    /// A run before its first epoch, of a network with its first weights; those are drawn from
    /// [`first_weights`](Self::first_weights).
    #[must_use]
    pub fn new(network: N, seed: u64, settings: Settings) -> Self {
        let adam = Adam::new(&network.parameters());
        Self { network, adam, seed, settings, epochs: Vec::new(), best: None }
    }

    /// The generator of the first weights of a run.
    #[must_use]
    pub fn first_weights(seed: u64) -> Pcg64Mcg {
        random::stream(seed, Purpose::Training, 0)
    }

    /// The epochs so far.
    #[must_use]
    pub fn epochs(&self) -> &[Epoch] {
        &self.epochs
    }

    /// The best epoch so far.
    #[must_use]
    pub fn best_epoch(&self) -> Option<&Epoch> {
        self.epochs.iter().rfind(|epoch| epoch.best)
    }

    /// Whether it has gone on for as long as it may, or as it is any use.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        let done = self.epochs.len();
        let best = self.best_epoch().map_or(done, |epoch| epoch.number);
        done >= self.settings.epochs || done - best >= self.settings.patience.max(1)
    }

    /// Learns from all training events once, in random order, and measures on the validation events.
    ///
    /// # Errors
    /// [`TrainingError`].
    pub fn epoch(
        &mut self,
        training: &[N::Sample],
        validation: &[N::Sample],
    ) -> core::result::Result<&Epoch, TrainingError> {
        for (name, samples) in [("training", training), ("validation", validation)] {
            if samples.is_empty() {
                return Err(TrainingError::NoEvents(name));
            }
        }
        let number = self.epochs.len() + 1;
        let mut random = random::stream(self.seed, Purpose::Training, number as u64);
        let mut order: Vec<&N::Sample> = training.iter().collect();
        order.shuffle(&mut random);
        let parameters = self.network.parameters();
        let mut learnt = Mean::default();
        for batch in order.chunks(self.settings.batch.max(1)) {
            let loss = self.network.loss(batch, Some(&mut random))?;
            learnt.add(&loss, batch.len())?;
            let Settings { learning_rate, longest_slope, .. } = self.settings;
            self.adam.step(&parameters, &loss.loss.backward()?, learning_rate, longest_slope)?;
        }
        let training = learnt.measure();
        let validation = measure(&self.network, validation, self.settings.batch)?;
        if !(training.loss.is_finite() && validation.loss.is_finite()) {
            return Err(TrainingError::Apart(number));
        }
        let short = N::shortcoming(&validation);
        let best = self.best_epoch().is_none_or(|epoch| short < N::shortcoming(&epoch.validation));
        if best {
            self.best = Some(parameters::numbers(&parameters)?);
        }
        self.epochs.push(Epoch { number, training, validation, best });
        self.epochs.last().ok_or(TrainingError::NoEvents("training"))
    }

    /// The network with the weights of its best epoch, or its first ones.
    ///
    /// # Errors
    /// If they cannot be put back.
    pub fn into_best(self) -> Result<N> {
        if let Some(best) = &self.best {
            parameters::set_numbers(&self.network.parameters(), best)?;
        }
        Ok(self.network)
    }
}

/// How good a network is on some samples; zeros without any.
///
/// # Errors
/// If there is no memory for it.
pub fn measure<N: Network>(network: &N, samples: &[N::Sample], batch: usize) -> Result<Measure> {
    let mut mean = Mean::default();
    let samples: Vec<&N::Sample> = samples.iter().collect();
    for batch in samples.chunks(batch.max(1)) {
        mean.add(&network.loss(batch, None)?, batch.len())?;
    }
    Ok(mean.measure())
}

/// A mean over batches, each sample counting alike.
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

    fn measure(self) -> Measure {
        let samples = self.samples.max(1.0);
        Measure {
            loss: self.loss / samples,
            scores: self.scores.into_iter().map(|sum| sum / samples).collect(),
        }
    }
}
