//! Layers whose initial weights come from PHASE's own generators.

use crate::parameters::Parameter;
use candle_core::{Device, Module, Result, Tensor, Var};
use candle_nn::Linear;
use phase_model::random::Pcg64Mcg;
use rand::RngExt;

/// A fully connected layer in training.
#[derive(Clone, Debug)]
pub struct Layer {
    weight: Var,
    bias: Var,
    linear: Linear,
}

impl Layer {
    /// A layer from `inputs` features (at least 1) to `outputs`; weights and biases are uniformly sampled
    /// from ±1/√inputs, the usual initialisation.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn new(inputs: usize, outputs: usize, random: &mut Pcg64Mcg) -> Result<Self> {
        let bound = 1.0 / (inputs.max(1) as f32).sqrt();
        let mut draw = |count: usize| -> Vec<f32> {
            (0..count).map(|_| bound * (2.0 * random.random::<f32>() - 1.0)).collect()
        };
        let weight = Var::from_vec(draw(outputs * inputs), (outputs, inputs), &Device::Cpu)?;
        let bias = Var::from_vec(draw(outputs), outputs, &Device::Cpu)?;
        let linear = Linear::new(weight.as_tensor().clone(), Some(bias.as_tensor().clone()));
        Ok(Self { weight, bias, linear })
    }

    /// The trainable parameters, for an optimiser.
    #[must_use]
    pub fn variables(&self) -> [Var; 2] {
        [self.weight.clone(), self.bias.clone()]
    }

    /// The trainable parameters with their names in a file of weights.
    #[must_use]
    pub fn parameters(&self, name: &str) -> Vec<Parameter> {
        vec![(format!("{name}.weight"), self.weight.clone()), (format!("{name}.bias"), self.bias.clone())]
    }

    /// The current weights row by row, one row for each output, and biases.
    ///
    /// # Errors
    /// If they cannot be read.
    pub fn values(&self) -> Result<(Vec<f32>, Vec<f32>)> {
        Ok((self.weight.flatten_all()?.to_vec1()?, self.bias.to_vec1()?))
    }
}

impl Module for Layer {
    fn forward(&self, inputs: &Tensor) -> Result<Tensor> {
        self.linear.forward(inputs)
    }
}

/// Sets a random share of the values to 0 and scales up the others; without a generator nothing.
pub(crate) fn dropout(values: &Tensor, share: f32, random: Option<&mut Pcg64Mcg>) -> Result<Tensor> {
    let Some(random) = random else { return Ok(values.clone()) };
    let keep = 1.0 - share;
    let mut factor = || if random.random::<f32>() < keep { 1.0 / keep } else { 0.0 };
    let factors: Vec<f32> = (0..values.elem_count()).map(|_| factor()).collect();
    values * Tensor::from_vec(factors, values.shape(), &Device::Cpu)?
}
