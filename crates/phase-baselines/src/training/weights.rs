//! A network at rest: a safetensors file.

use super::{
    Network, TensorsError,
    tensors::{File, Named, write},
};
use crate::parameters;

const FIELD: &str = "format";

/// The network's weights as a file. The same weights always give the same bytes.
///
/// # Errors
/// If they cannot be read or laid out in a file.
pub fn to_safetensors<N: Network>(network: &N) -> Result<Vec<u8>, TensorsError> {
    let parameters = network.parameters();
    let numbers = parameters::numbers(&parameters)?;
    let named = parameters.into_iter().zip(numbers).map(|((name, variable), numbers)| Named {
        name,
        shape: variable.dims().into(),
        numbers,
    });
    write(&named.collect::<Vec<_>>(), FIELD, &format::<N>())
}

/// Gives a network the weights that [`to_safetensors`] wrote; its own must have the same shapes.
///
/// # Errors
/// For bytes that are no such file or one of another network, and for tensors that are missing, too many, of another
/// shape or not finite. The network is then as it was.
pub fn from_safetensors<N: Network>(network: N, bytes: &[u8]) -> Result<N, TensorsError> {
    let file = File::open(bytes, FIELD)?;
    if file.says() != Some(&format::<N>()) {
        return Err(TensorsError::Kind { field: FIELD, expected: format::<N>() });
    }
    let parameters = network.parameters();
    if let Some(name) = file.names().find(|name| !parameters.iter().any(|(known, _)| known == name)) {
        return Err(TensorsError::Unknown(name.into()));
    }
    let numbers = parameters.iter().map(|(name, variable)| file.numbers(name, variable.dims()));
    let numbers = numbers.collect::<Result<Vec<_>, _>>()?;
    parameters::set_numbers(&parameters, &numbers)?;
    Ok(network)
}

/// What the entry `format` of the metadata says.
fn format<N: Network>() -> String {
    format!("phase-{}/1", N::NAME)
}
