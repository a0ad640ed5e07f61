//! A network on disk: a safetensors file.

use super::Network;
use crate::parameters;
use phase_tensors::{NamedTensor, TensorFile, TensorsError, write};
use thiserror::Error;

const FIELD: &str = "format";

/// Why a network cannot be saved or loaded.
#[derive(Debug, Error)]
pub enum NetworkError {
    /// The bytes are not such a file, or belong to another network.
    #[error(transparent)]
    Tensors(#[from] TensorsError),
    /// The network cannot be read or changed.
    #[error("the network cannot be read or changed: {0}")]
    Network(#[from] candle_core::Error),
}

/// The network's weights as a file. The same weights always give the same bytes.
///
/// # Errors
/// If they cannot be read or laid out in a file.
pub fn to_safetensors<N: Network>(network: &N) -> Result<Vec<u8>, NetworkError> {
    let parameters = network.parameters();
    let values = parameters::values(&parameters)?;
    let named = parameters.into_iter().zip(values).map(|((name, variable), values)| NamedTensor {
        name,
        shape: variable.dims().into(),
        values,
    });
    Ok(write(&named.collect::<Vec<_>>(), FIELD, &format::<N>())?)
}

/// Gives a network the weights that [`to_safetensors`] wrote; its own must have the same shapes.
///
/// # Errors
///
/// For bytes that are not such a file or belong to another network, and for tensors that are missing,
/// unexpected, of another shape or not finite. The network is then unchanged.
pub fn from_safetensors<N: Network>(network: N, bytes: &[u8]) -> Result<N, NetworkError> {
    let file = TensorFile::open_as(bytes, FIELD, &format::<N>())?;
    let parameters = network.parameters();
    file.check_names(|name| parameters.iter().any(|(known, _)| known == name))?;
    let values = parameters.iter().map(|(name, variable)| file.values(name, variable.dims()));
    let values = values.collect::<Result<Vec<_>, _>>()?;
    parameters::set_values(&parameters, &values)?;
    Ok(network)
}

/// The value of the entry `format` of the metadata.
fn format<N: Network>() -> String {
    format!("phase-{}/1", N::NAME)
}
