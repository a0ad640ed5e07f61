//! Trainable parameters as named tensors, read from a network and written to it.

use candle_core::{Result, Tensor, Var};

/// A trainable tensor and its name, which is unique in its network.
pub type Parameter = (String, Var);

/// The current values of the parameters, each row by row.
///
/// # Errors
/// If they cannot be read.
pub fn values(parameters: &[Parameter]) -> Result<Vec<Vec<f32>>> {
    parameters.iter().map(|(_, variable)| variable.flatten_all()?.to_vec1()).collect()
}

/// Sets the values of parameters, in the same order.
///
/// # Errors
/// If there are too few or too many values for one of them.
pub fn set_values(parameters: &[Parameter], values: &[Vec<f32>]) -> Result<()> {
    for ((_, variable), values) in parameters.iter().zip(values) {
        variable.set(&Tensor::from_slice(values, variable.shape(), variable.device())?)?;
    }
    Ok(())
}
