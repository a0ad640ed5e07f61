//! `train`: trains neural networks on a dataset.

pub mod options;

use crate::{context::Context, error::CliError, eval::require_networks};
use options::Train;

/// Runs the command.
///
/// # Errors
/// [`CliError::Run`], or [`CliError::NotBuilt`] where the program was built without the feature `networks`.
pub fn run(arguments: &Train, context: &Context) -> Result<(), CliError> {
    require_networks(context)?;
    train(arguments, context)
}

#[cfg(feature = "networks")]
fn train(arguments: &Train, context: &Context) -> Result<(), CliError> {
    let trained = phase_runs::train::Training::from(arguments).run(context)?;
    arguments.options().output.print(trained.text, &trained.figures)
}

#[cfg(not(feature = "networks"))]
const fn train(_: &Train, _: &Context) -> Result<(), CliError> {
    Ok(())
}
