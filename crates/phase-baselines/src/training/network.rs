//! The interface of trainable networks.

use super::Metrics;
use crate::parameters::Parameter;
use candle_core::{Result, Tensor};
use phase_model::random::Pcg64Mcg;

/// A network, as seen by training.
pub trait Network {
    /// An example to train and evaluate with: an event with its targets.
    type Sample;

    /// Its name, in commands and files.
    const NAME: &'static str;

    /// The names of the metrics beside the loss.
    const METRICS: &'static [&'static str];

    /// Trainable parameters, always in the same order.
    fn parameters(&self) -> Vec<Parameter>;

    /// Loss and metrics over some samples, at least one. With a generator the network is in training mode and
    /// may sample its input; without one it is evaluated deterministically.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    fn loss(&self, samples: &[&Self::Sample], random: Option<&mut Pcg64Mcg>) -> Result<Loss>;

    /// The criterion minimised over rounds on the validation events; the loss unless overridden.
    #[must_use]
    fn selection_loss(evaluate: &Metrics) -> f64 {
        evaluate.loss
    }
}

/// Loss and metrics of a network over some samples, each with equal weight.
#[derive(Clone, Debug)]
pub struct Loss {
    /// The loss to minimise: a scalar with its computation graph.
    pub loss: Tensor,
    /// One value for each of [`Network::METRICS`].
    pub scores: Vec<f64>,
}
