//! The strength regressor on disk: a safetensors file.

use super::{StrengthRegressor, Weights, WeightsError};
use phase_tensors::{Dense, vector};
use phase_tensors::{TensorFile, write};

/// The value of the field `format` of the file's metadata.
pub const STRENGTH_FORMAT: &str = "phase-strength/1";

impl StrengthRegressor {
    /// Reads what [`to_safetensors`](Self::to_safetensors) wrote.
    ///
    /// # Errors
    /// [`WeightsError`] for bytes that are not such a file, tensors that are missing or do not match each
    /// other, and values that are not finite or not above 0 where they must be.
    pub fn from_safetensors(bytes: &[u8]) -> Result<Self, WeightsError> {
        let file = TensorFile::open_as(bytes, "format", STRENGTH_FORMAT)?;
        let rmse = file.values("validation.rmse", &[1])?;
        Self::new(Weights {
            mean: vector(&file, "input.mean")?,
            scale: vector(&file, "input.scale")?,
            hidden: [Dense::read(&file, "hidden1")?, Dense::read(&file, "hidden2")?],
            output: Dense::read(&file, "output")?,
            rmse: rmse.first().copied().unwrap_or_default(),
        })
    }

    /// The regressor as a safetensors file. The same regressor always gives the same bytes.
    ///
    /// # Errors
    /// [`WeightsError::Tensors`] if the tensors cannot be laid out in a file.
    pub fn to_safetensors(&self) -> Result<Vec<u8>, WeightsError> {
        Ok(write(&self.weights().tensors(), "format", STRENGTH_FORMAT)?)
    }
}
