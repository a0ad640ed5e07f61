//! Behaviour of a program that was built without networks.

use crate::{context::Context, error::CliError};
use phase_eval::benchmark::Training;
use phase_event::{Forecaster, Recogniser};
use std::path::Path;

/// Checks that this program has networks.
///
/// # Errors
/// [`CliError::NoNetworks`], always.
pub const fn require(context: &Context) -> Result<(), CliError> {
    Err(CliError::NoNetworks { hint: context.program.networks_hint })
}

/// Nothing: this program has no networks.
///
/// # Errors
/// None.
pub const fn recogniser(_: &str, _: Option<&Path>) -> Result<Option<Box<dyn Recogniser>>, CliError> {
    Ok(None)
}

/// Nothing: this program has no networks.
///
/// # Errors
/// None.
pub const fn forecaster(_: &str, _: Option<&Path>) -> Result<Option<Box<dyn Forecaster>>, CliError> {
    Ok(None)
}

/// Nothing: no method of this program was trained.
///
/// # Errors
/// None.
pub const fn training(_: &str) -> Result<Option<Training>, CliError> {
    Ok(None)
}

/// The training record of a file of weights, which is only available in a program with networks.
///
/// # Errors
/// Always.
pub fn training_of(file: &Path) -> Result<Training, CliError> {
    Err(CliError::Usage(format!("{}: is for a neural network, which this program has not", file.display())))
}
