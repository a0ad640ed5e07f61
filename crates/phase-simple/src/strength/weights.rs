//! Weights of the strength regressor and their constraints.

use super::FEATURES;
use phase_tensors::Dense;
use phase_tensors::{NamedTensor, TensorsError, check_shape};
use thiserror::Error;

/// The parameters of a [`StrengthRegressor`](super::StrengthRegressor).
#[derive(Clone, PartialEq, Debug)]
pub struct Weights {
    /// Mean of each of the [`FEATURES`] over the training samples.
    pub mean: Vec<f32>,
    /// Scale that each feature is divided by after its mean is subtracted: its standard deviation; above 0.
    pub scale: Vec<f32>,
    /// The hidden layers, each followed by max(0, ·); the first takes the features.
    pub hidden: [Dense; 2],
    /// From the last hidden layer to the force (N).
    pub output: Dense,
    /// Root mean squared error on held-out events (N); above 0. The uncertainty of an estimate.
    pub rmse: f32,
}

/// Why tensors cannot be used as a strength regressor.
#[derive(Debug, Error)]
pub enum WeightsError {
    /// The bytes are not such a file, or a tensor is invalid.
    #[error(transparent)]
    Tensors(#[from] TensorsError),
    /// A scale or error is not above 0.
    #[error("tensor `{0}` must hold numbers above 0")]
    NotPositive(String),
}

impl Weights {
    /// Checks that layers match each other and that all values are valid.
    ///
    /// # Errors
    /// The first rule that is broken, with the tensor's name.
    pub fn check(&self) -> Result<(), WeightsError> {
        check_shape("input.mean", &[FEATURES], &[self.mean.len()])?;
        check_shape("input.scale", &[FEATURES], &[self.scale.len()])?;
        let [first, second] = &self.hidden;
        let layers = [
            ("hidden1", first, FEATURES, first.outputs.max(1)),
            ("hidden2", second, first.outputs, second.outputs.max(1)),
            ("output", &self.output, second.outputs, 1),
        ];
        for (name, layer, inputs, outputs) in layers {
            let weight = format!("{name}.weight");
            check_shape(&weight, &[outputs, inputs], &[layer.outputs, layer.inputs])?;
            // A product that overflows is not a valid length.
            let values = outputs.saturating_mul(inputs);
            check_shape(&weight, &[values], &[layer.weight.len()])?;
            check_shape(&format!("{name}.bias"), &[outputs], &[layer.bias.len()])?;
        }
        for NamedTensor { name, values, .. } in self.tensors() {
            if !values.iter().all(|number| number.is_finite()) {
                return Err(TensorsError::NotFinite(name).into());
            }
        }
        for (name, data) in [("input.scale", &*self.scale), ("validation.rmse", &[self.rmse])] {
            if !data.iter().all(|&number| number > 0.0) {
                return Err(WeightsError::NotPositive(name.into()));
            }
        }
        Ok(())
    }

    /// Every tensor, as stored in a file.
    pub(super) fn tensors(&self) -> [NamedTensor; 9] {
        let [first, second] = &self.hidden;
        let weight = |layer: &Dense| vec![layer.outputs, layer.inputs];
        let tensor = |name: &str, shape: Vec<usize>, values: &[f32]| NamedTensor {
            name: name.into(),
            shape,
            values: values.into(),
        };
        let vector = |name, values: &[f32]| tensor(name, vec![values.len()], values);
        [
            vector("input.mean", &self.mean),
            vector("input.scale", &self.scale),
            tensor("hidden1.weight", weight(first), &first.weight),
            vector("hidden1.bias", &first.bias),
            tensor("hidden2.weight", weight(second), &second.weight),
            vector("hidden2.bias", &second.bias),
            tensor("output.weight", weight(&self.output), &self.output.weight),
            vector("output.bias", &self.output.bias),
            vector("validation.rmse", &[self.rmse]),
        ]
    }
}
