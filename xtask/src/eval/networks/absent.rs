//! What is said of networks by a program that was built without them.

use crate::error::CliError;
use phase_eval::{Forecaster, Recogniser};
use std::path::Path;

/// Nothing, unless the name is that of a network for goals and relations.
///
/// # Errors
/// For a network: that this program has none.
pub fn recogniser(name: &str, _: Option<&Path>) -> Result<Option<Box<dyn Recogniser>>, CliError> {
    if matches!(name, "two-level-lstm" | "arg") { Err(elsewhere(name, "goals")) } else { Ok(None) }
}

/// Nothing, unless the name is that of a network for trajectories.
///
/// # Errors
/// For a network: that this program has none.
pub fn forecaster(name: &str, _: Option<&Path>) -> Result<Option<Box<dyn Forecaster>>, CliError> {
    if matches!(name, "social-lstm" | "stgat") { Err(elsewhere(name, "trajectories")) } else { Ok(None) }
}

fn elsewhere(name: &str, task: &str) -> CliError {
    CliError::Usage(format!(
        "--method: {name} is a neural network, which this program was built without; use `cargo xtask-networks eval {task} --method {name} …`"
    ))
}
