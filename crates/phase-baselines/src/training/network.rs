//! What can be trained.

use super::Measure;
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
    const SCORES: &'static [&'static str];

    /// What is to be learnt, always in the same order.
    fn parameters(&self) -> Vec<Parameter>;

    /// How wrong it is about some samples, at least one. While it learns, whatever it draws comes from the generator; without
    /// one it is measured, and draws nothing.
    ///
    /// # Errors
    /// If there is no memory for it.
    fn loss(&self, samples: &[&Self::Sample], chance: Option<&mut Pcg64Mcg>) -> Result<Loss>;

    /// What has to become less on the validation events for a round to be better than others: the loss, unless there is
    /// something that is more what the network is for.
    #[must_use]
    fn shortcoming(measure: &Measure) -> f64 {
        measure.loss
    }
}

/// How wrong a network is about some samples, each of them counting alike.
#[derive(Clone, Debug)]
pub struct Loss {
    /// What is to become less: one number that knows where it comes from.
    pub loss: Tensor,
    /// A number for each of [`Network::SCORES`].
    pub scores: Vec<f64>,
}
