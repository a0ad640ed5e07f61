//! `train`: neural networks learn from a dataset.

#[cfg(feature = "networks")]
pub mod error;
#[cfg(feature = "networks")]
mod events;
#[cfg(feature = "networks")]
mod forecasting;
#[cfg(feature = "networks")]
mod kept;
#[cfg(feature = "networks")]
mod network;
pub mod options;
#[cfg(feature = "networks")]
mod recognition;
#[cfg(feature = "networks")]
mod strength;

use crate::{context::Context, error::CliError, eval::networks};
use options::Train;

/// Runs the command.
///
/// # Errors
/// [`CliError::Train`], or [`CliError::NoNetworks`] where the program was built without the feature `networks`.
pub fn run(arguments: &Train, context: &Context) -> Result<(), CliError> {
    networks::require(context)?;
    train(arguments)
}

#[cfg(feature = "networks")]
fn train(arguments: &Train) -> Result<(), CliError> {
    match arguments {
        Train::Strength(options) => strength::run(options),
        Train::TwoLevelLstm(options) => recognition::two_level_lstm(options),
        Train::Arg(options) => recognition::arg(options),
        Train::SocialLstm(options) => forecasting::social_lstm(options),
        Train::Stgat(options) => forecasting::stgat(options),
    }?;
    Ok(())
}

#[cfg(not(feature = "networks"))]
const fn train(_: &Train) -> Result<(), CliError> {
    Ok(())
}
