//! Fully connected layers one after the other.

use crate::{layer::Layer, parameters::Parameter};
use candle_core::{Module, Result, Tensor};
use phase_model::random::Pcg64Mcg;

/// Fully connected layers with ReLU after each but the last.
#[derive(Clone, Debug)]
pub struct Perceptron {
    layers: Vec<Layer>,
}

impl Perceptron {
    /// Layers between consecutive sizes, of which there are at least two.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn new(sizes: &[usize], random: &mut Pcg64Mcg) -> Result<Self> {
        let layers = sizes.windows(2).map(|pair| Layer::new(pair[0], pair[1], random));
        Ok(Self { layers: layers.collect::<Result<_>>()? })
    }

    /// The paper's head: three hidden layers as wide as the input, then one output for each class.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn head(hidden: usize, logits: usize, random: &mut Pcg64Mcg) -> Result<Self> {
        Self::new(&[hidden, hidden, hidden, hidden, logits], random)
    }

    /// Trainable parameters with their names.
    #[must_use]
    pub fn parameters(&self, name: &str) -> Vec<Parameter> {
        let layers = self.layers.iter().enumerate();
        layers.flat_map(|(k, layer)| layer.parameters(&format!("{name}.{k}"))).collect()
    }
}

impl Module for Perceptron {
    fn forward(&self, inputs: &Tensor) -> Result<Tensor> {
        let mut values = inputs.clone();
        for (k, layer) in self.layers.iter().enumerate() {
            values = if k == 0 { layer.forward(&values)? } else { layer.forward(&values.relu()?)? };
        }
        Ok(values)
    }
}
