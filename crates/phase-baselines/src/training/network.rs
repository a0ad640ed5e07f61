//! What can be trained.

use super::Metrics;
use crate::parameters::Parameter;
use candle_core::{Result, Tensor};
use phase_model::random::Pcg64Mcg;

/// A network, from where its training sees it.
pub trait Network {
    /// What it learns from and is measured on: an event and whatever it is to say of it.
    type Sample;

    /// Its name, in commands and files.
    const NAME: &'static str;

    /// What is measured beside the loss, by name.
    const METRICS: &'static [&'static str];

    /// Trainable parameters, always in the same order.
    fn parameters(&self) -> Vec<Parameter>;

    /// Loss and metrics over some samples, at least one. With a generator the network is in training mode and may
    /// sample its input; without one it is evaluated deterministically.
    ///
    /// # Errors If a tensor cannot be allocated.
    fn loss(&self, samples: &[&Self::Sample], random: Option<&mut Pcg64Mcg>) -> Result<Loss>;

    /// The criterion minimised over rounds on the validation events; the loss unless overridden.
    #[must_use]
    fn selection_loss(evaluate: &Metrics) -> f64 {
        evaluate.loss
    }
}

/// How wrong a network is about some samples, each of them counting alike.
#[derive(Clone, Debug)]
pub struct Loss {
    /// What is to become less: one number that knows where it comes from.
    pub loss: Tensor,
    /// A number for each of [`Network::METRICS`].
    pub scores: Vec<f64>,
}
