//! `train`: trains neural networks on a dataset.

pub mod options;

#[cfg(feature = "networks")]
use crate::json_file;
use crate::{context::Context, error::CliError, eval::require_networks};
use options::Train;

/// Runs the command.
///
/// # Errors
/// [`CliError::Usage`], if the weights cannot be written; [`CliError::Run`]; or [`CliError::NotBuilt`] where
/// the program was built without the feature `networks`.
pub fn run(arguments: &Train, context: &Context) -> Result<(), CliError> {
    require_networks(context)?;
    train(arguments, context)
}

#[cfg(feature = "networks")]
fn train(arguments: &Train, context: &Context) -> Result<(), CliError> {
    let options = arguments.options();
    json_file::check("--out", &options.out, [&options.data])?;
    let trained = phase_runs::train::Training::from(arguments).run(context)?;
    options.output.print(trained.text, &trained.figures)
}

#[cfg(not(feature = "networks"))]
const fn train(_: &Train, _: &Context) -> Result<(), CliError> {
    Ok(())
}
