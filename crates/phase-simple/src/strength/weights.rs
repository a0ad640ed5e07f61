//! The numbers of the strength regressor, and what they have to be.

use super::FEATURES;
use thiserror::Error;

/// One fully connected layer: output o is bias\[o\] + Σ weight\[o · inputs + i\] · input\[i\].
#[derive(Clone, PartialEq, Debug)]
pub struct Dense {
    /// Length of what comes in.
    pub inputs: usize,
    /// Length of what goes out.
    pub outputs: usize,
    /// Row by row, `outputs` rows of `inputs` numbers.
    pub weight: Vec<f32>,
    /// `outputs` numbers.
    pub bias: Vec<f32>,
}

/// What a [`StrengthRegressor`](super::StrengthRegressor) is made of.
#[derive(Clone, PartialEq, Debug)]
pub struct Weights {
    /// Mean of each of the [`FEATURES`] over the samples trained on.
    pub mean: Vec<f32>,
    /// What each feature is divided by once its mean is taken away: its standard deviation; above 0.
    pub scale: Vec<f32>,
    /// The hidden layers, each followed by max(0, ·); the first takes the features.
    pub hidden: [Dense; 2],
    /// From the last hidden layer to the force (N).
    pub output: Dense,
    /// Root mean squared error on events not trained on (N); above 0. How sure an estimate is.
    pub rmse: f32,
}

/// Why some numbers cannot be a strength regressor.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum WeightsError {
    /// The bytes are something else.
    #[error("is no safetensors file: {0}")]
    Container(String),
    /// It is a file of tensors, but of another kind.
    #[error("field `format` must be {:?}", super::STRENGTH_FORMAT)]
    Format,
    /// A tensor is not there.
    #[error("tensor `{0}` is missing")]
    Missing(String),
    /// A tensor holds another type of numbers.
    #[error("tensor `{0}` must hold 32-bit floats")]
    Type(String),
    /// A tensor does not fit to the others.
    #[error("tensor `{name}` must have the shape {expected:?}, not {found:?}")]
    Shape {
        /// The tensor.
        name: String,
        /// What it must have.
        expected: Vec<usize>,
        /// What it has.
        found: Vec<usize>,
    },
    /// A number is none.
    #[error("tensor `{0}` must hold finite numbers")]
    NotFinite(String),
    /// A scale or error is not above 0.
    #[error("tensor `{0}` must hold numbers above 0")]
    NotPositive(String),
}

impl Weights {
    /// Checks that layers fit to each other and that all numbers are what they have to be.
    ///
    /// # Errors
    /// The first rule that is broken, with the tensor's name.
    pub fn check(&self) -> Result<(), WeightsError> {
        shape("input.mean", &[FEATURES], &[self.mean.len()])?;
        shape("input.scale", &[FEATURES], &[self.scale.len()])?;
        let [first, second] = &self.hidden;
        let layers = [
            ("hidden1", first, FEATURES, first.outputs.max(1)),
            ("hidden2", second, first.outputs, second.outputs.max(1)),
            ("output", &self.output, second.outputs, 1),
        ];
        for (name, layer, inputs, outputs) in layers {
            let weight = format!("{name}.weight");
            shape(&weight, &[outputs, inputs], &[layer.outputs, layer.inputs])?;
            // A product that overflows is no length of anything.
            let numbers = outputs.saturating_mul(inputs);
            shape(&weight, &[numbers], &[layer.weight.len()])?;
            shape(&format!("{name}.bias"), &[outputs], &[layer.bias.len()])?;
        }
        for (name, _, data) in self.tensors() {
            if !data.iter().all(|number| number.is_finite()) {
                return Err(WeightsError::NotFinite(name.into()));
            }
        }
        for (name, data) in [("input.scale", &*self.scale), ("validation.rmse", &[self.rmse])] {
            if !data.iter().all(|&number| number > 0.0) {
                return Err(WeightsError::NotPositive(name.into()));
            }
        }
        Ok(())
    }

    /// Name, shape and numbers of every tensor, as they stand in a file.
    pub(super) fn tensors(&self) -> [(&'static str, Vec<usize>, &[f32]); 9] {
        let [first, second] = &self.hidden;
        let weight = |layer: &Dense| vec![layer.outputs, layer.inputs];
        [
            ("input.mean", vec![self.mean.len()], &self.mean),
            ("input.scale", vec![self.scale.len()], &self.scale),
            ("hidden1.weight", weight(first), &first.weight),
            ("hidden1.bias", vec![first.bias.len()], &first.bias),
            ("hidden2.weight", weight(second), &second.weight),
            ("hidden2.bias", vec![second.bias.len()], &second.bias),
            ("output.weight", weight(&self.output), &self.output.weight),
            ("output.bias", vec![self.output.bias.len()], &self.output.bias),
            ("validation.rmse", vec![1], core::slice::from_ref(&self.rmse)),
        ]
    }
}

pub(super) fn shape(name: &str, expected: &[usize], found: &[usize]) -> Result<(), WeightsError> {
    if expected == found {
        return Ok(());
    }
    Err(WeightsError::Shape { name: name.into(), expected: expected.into(), found: found.into() })
}
