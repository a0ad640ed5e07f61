//! `train`: trains neural networks on a dataset.

#[cfg(feature = "networks")]
mod events;
#[cfg(feature = "networks")]
mod forecasting;
#[cfg(feature = "networks")]
mod intent_network;
#[cfg(feature = "networks")]
mod network;
pub mod options;
#[cfg(feature = "networks")]
mod recognition;
#[cfg(feature = "networks")]
mod strength;
#[cfg(feature = "networks")]
mod training_files;

use crate::{context::Context, error::CliError, eval::networks};
use options::Train;

/// Runs the command.
///
/// # Errors
/// [`CliError::Train`], or [`CliError::NoNetworks`] where the program was built without the feature `networks`.
pub fn run(arguments: &Train, context: &Context) -> Result<(), CliError> {
    networks::require(context)?;
    train(arguments, context)
}

#[cfg(feature = "networks")]
fn train(arguments: &Train, context: &Context) -> Result<(), CliError> {
    match arguments {
        Train::Strength(options) => strength::run(options, context),
        Train::IntentNetwork(options) => intent_network::run(options, context),
        Train::TwoLevelLstm(options) => recognition::two_level_lstm(options, context),
        Train::Arg(options) => recognition::arg(options, context),
        Train::SocialGnn(options) => recognition::social_gnn(options, context),
        Train::SocialLstm(options) => forecasting::social_lstm(options, context),
        Train::Stgat(options) => forecasting::stgat(options, context),
    }
}

#[cfg(not(feature = "networks"))]
const fn train(_: &Train, _: &Context) -> Result<(), CliError> {
    Ok(())
}
