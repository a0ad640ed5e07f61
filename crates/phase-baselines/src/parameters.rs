//! What networks have learnt: named tensors, out of a network and into it.

use candle_core::{Result, Tensor, Var};

/// A tensor to be learnt and its name, which is different from all others of its network.
pub type Parameter = (String, Var);

/// The numbers of parameters as they are now, each row by row.
///
/// # Errors
/// If they cannot be read.
pub fn values(parameters: &[Parameter]) -> Result<Vec<Vec<f32>>> {
    parameters.iter().map(|(_, variable)| variable.flatten_all()?.to_vec1()).collect()
}

/// Gives parameters other numbers, in the same order.
///
/// # Errors
/// If there are too few or too many numbers for one of them.
pub fn set_values(parameters: &[Parameter], values: &[Vec<f32>]) -> Result<()> {
    for ((_, variable), values) in parameters.iter().zip(values) {
        variable.set(&Tensor::from_slice(values, variable.shape(), variable.device())?)?;
    }
    Ok(())
}
