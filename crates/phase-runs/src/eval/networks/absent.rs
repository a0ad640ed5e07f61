//! Behaviour of a program that was built without networks.

use crate::error::RunError;
use phase_eval::benchmark::Training;
use phase_event::{BeliefReader, Forecaster, Recogniser};
use std::path::Path;

/// Nothing: this program has no networks.
pub(crate) const fn recogniser(_: &str, _: Option<&Path>) -> Result<Option<Box<dyn Recogniser>>, RunError> {
    Ok(None)
}

/// Nothing: this program has no networks.
pub(crate) const fn forecaster(_: &str, _: Option<&Path>) -> Result<Option<Box<dyn Forecaster>>, RunError> {
    Ok(None)
}

/// Nothing: this program has no networks.
pub(crate) const fn belief_reader(
    _: &str,
    _: Option<&Path>,
) -> Result<Option<Box<dyn BeliefReader>>, RunError> {
    Ok(None)
}

/// Nothing: no method of this program was trained.
pub(crate) const fn training(_: &str) -> Result<Option<Training>, RunError> {
    Ok(None)
}

/// The training record of a file of weights, which is only available in a program with networks.
pub(crate) fn training_of(file: &Path) -> Result<Training, RunError> {
    Err(RunError::Usage(format!("{}: is for a neural network, which this program has not", file.display())))
}
