//! The strength regressor at rest: a safetensors file.

use super::{Dense, StrengthRegressor, Weights, WeightsError, weights::shape};
use safetensors::{Dtype, SafeTensors, tensor::TensorView};
use std::collections::HashMap;

/// What the field `format` of the file's metadata says.
pub const STRENGTH_FORMAT: &str = "phase-strength/1";

impl StrengthRegressor {
    /// Reads what [`to_safetensors`](Self::to_safetensors) wrote.
    ///
    /// # Errors
    /// [`WeightsError`] for bytes that are no such file, tensors that are missing or do not fit to each other, and
    /// numbers that are not finite or not above 0 where they must be.
    pub fn from_safetensors(bytes: &[u8]) -> Result<Self, WeightsError> {
        let broken = |error: safetensors::SafeTensorError| WeightsError::Container(error.to_string());
        let (_, metadata) = SafeTensors::read_metadata(bytes).map_err(broken)?;
        let file = SafeTensors::deserialize(bytes).map_err(broken)?;
        let format = metadata.metadata().as_ref().and_then(|metadata| metadata.get("format"));
        if format.map(String::as_str) != Some(STRENGTH_FORMAT) {
            return Err(WeightsError::Format);
        }
        let rmse = vector(&file, "validation.rmse")?;
        let [rmse] = rmse[..] else {
            return Err(shape("validation.rmse", &[1], &[rmse.len()]).err().unwrap_or(WeightsError::Format));
        };
        Self::new(Weights {
            mean: vector(&file, "input.mean")?,
            scale: vector(&file, "input.scale")?,
            hidden: [dense(&file, "hidden1")?, dense(&file, "hidden2")?],
            output: dense(&file, "output")?,
            rmse,
        })
    }

    /// The regressor as a safetensors file. The same regressor always gives the same bytes.
    ///
    /// # Errors
    /// [`WeightsError::Container`] if the tensors cannot be laid out in a file.
    pub fn to_safetensors(&self) -> Result<Vec<u8>, WeightsError> {
        let broken = |error: safetensors::SafeTensorError| WeightsError::Container(error.to_string());
        let tensors = self.weights().tensors();
        let bytes = tensors.each_ref().map(|(_, _, numbers)| {
            numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>()
        });
        let views = tensors.iter().zip(&bytes).map(|((name, shape, _), bytes)| {
            Ok((*name, TensorView::new(Dtype::F32, shape.clone(), bytes).map_err(broken)?))
        });
        let views: Vec<_> = views.collect::<Result<_, WeightsError>>()?;
        // One entry alone: more would stand in the file in an order that changes from run to run.
        let metadata = HashMap::from([("format".to_owned(), STRENGTH_FORMAT.to_owned())]);
        safetensors::serialize(views, Some(metadata)).map_err(broken)
    }
}

fn dense(file: &SafeTensors<'_>, name: &str) -> Result<Dense, WeightsError> {
    let weight_name = format!("{name}.weight");
    let (size, weight) = tensor(file, &weight_name)?;
    let bias = vector(file, &format!("{name}.bias"))?;
    let [outputs, inputs] = size[..] else {
        return Err(WeightsError::Shape { name: weight_name, expected: vec![bias.len(), 0], found: size });
    };
    Ok(Dense { inputs, outputs, weight, bias })
}

fn vector(file: &SafeTensors<'_>, name: &str) -> Result<Vec<f32>, WeightsError> {
    let (size, numbers) = tensor(file, name)?;
    shape(name, &[numbers.len()], &size)?;
    Ok(numbers)
}

/// Shape and numbers of a tensor.
fn tensor(file: &SafeTensors<'_>, name: &str) -> Result<(Vec<usize>, Vec<f32>), WeightsError> {
    let view = file.tensor(name).map_err(|_| WeightsError::Missing(name.into()))?;
    if view.dtype() != Dtype::F32 {
        return Err(WeightsError::Type(name.into()));
    }
    let (numbers, _) = view.data().as_chunks();
    Ok((view.shape().to_vec(), numbers.iter().map(|&bytes| f32::from_le_bytes(bytes)).collect()))
}
