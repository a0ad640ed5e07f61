//! A network at rest: a safetensors file.

use super::Network;
use crate::parameters;
use phase_tensors::{NamedTensor, TensorFile, TensorsError, write};
use thiserror::Error;

const FIELD: &str = "format";

/// Why a network cannot be kept, or cannot be what was kept.
#[derive(Debug, Error)]
pub enum NetworkError {
    /// The file is no such file, or not of this network.
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
    let numbers = parameters::numbers(&parameters)?;
    let named = parameters.into_iter().zip(numbers).map(|((name, variable), numbers)| NamedTensor {
        name,
        shape: variable.dims().into(),
        numbers,
    });
    Ok(write(&named.collect::<Vec<_>>(), FIELD, &format::<N>())?)
}

/// Gives a network the weights that [`to_safetensors`] wrote; its own must have the same shapes.
///
/// # Errors
/// For bytes that are no such file or one of another network, and for tensors that are missing, too many, of another
/// shape or not finite. The network is then as it was.
pub fn from_safetensors<N: Network>(network: N, bytes: &[u8]) -> Result<N, NetworkError> {
    let file = TensorFile::open_kind(bytes, FIELD, &format::<N>())?;
    let parameters = network.parameters();
    file.check_names(|name| parameters.iter().any(|(known, _)| known == name))?;
    let numbers = parameters.iter().map(|(name, variable)| file.numbers(name, variable.dims()));
    let numbers = numbers.collect::<Result<Vec<_>, _>>()?;
    parameters::set_numbers(&parameters, &numbers)?;
    Ok(network)
}

/// What the entry `format` of the metadata says.
fn format<N: Network>() -> String {
    format!("phase-{}/1", N::NAME)
}
