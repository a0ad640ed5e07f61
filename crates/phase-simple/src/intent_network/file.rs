//! The intent network on disk: a safetensors file.

use super::{FEATURES, IntentNetwork, OUTPUTS};
use phase_tensors::Dense;
use phase_tensors::{TensorFile, TensorsError, check_shape};
use thiserror::Error;

/// The value of the field `format` of the file's metadata.
pub const INTENT_NETWORK_FORMAT: &str = "phase-intent-network/1";

/// Why tensors cannot be used as an intent network.
#[derive(Debug, Error)]
pub enum IntentNetworkError {
    /// The bytes are not such a file, or a tensor is missing, of another shape or not finite.
    #[error(transparent)]
    Tensors(#[from] TensorsError),
}

impl IntentNetwork {
    /// Reads a file as `train intent-network` writes it.
    ///
    /// # Errors
    /// [`IntentNetworkError`].
    pub fn from_safetensors(bytes: &[u8]) -> Result<Self, IntentNetworkError> {
        let file = TensorFile::open_as(bytes, "format", INTENT_NETWORK_FORMAT)?;
        let layer = |name| Dense::read(&file, name);
        let network = Self {
            embedding: layer("embedding")?,
            memory: layer("memory")?,
            hidden: layer("hidden")?,
            output: layer("output")?,
        };
        network.check()?;
        Ok(network)
    }

    /// Checks that layers match each other and that all values are finite.
    fn check(&self) -> Result<(), TensorsError> {
        let units = self.units().max(1);
        // A product that overflows is not a valid length.
        let twice = units.saturating_mul(2);
        let four = units.saturating_mul(4);
        for (name, layer, inputs, outputs) in [
            ("embedding", &self.embedding, FEATURES, units),
            ("memory", &self.memory, twice, four),
            ("hidden", &self.hidden, units, units),
            ("output", &self.output, units, OUTPUTS),
        ] {
            let weight = format!("{name}.weight");
            check_shape(&weight, &[outputs, inputs], &[layer.outputs, layer.inputs])?;
            check_shape(&weight, &[outputs.saturating_mul(inputs)], &[layer.weight.len()])?;
            check_shape(&format!("{name}.bias"), &[outputs], &[layer.bias.len()])?;
            if !layer.weight.iter().chain(&layer.bias).all(|number| number.is_finite()) {
                return Err(TensorsError::NotFinite(weight));
            }
        }
        Ok(())
    }
}
