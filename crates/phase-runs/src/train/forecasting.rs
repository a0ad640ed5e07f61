//! `social-lstm` and `stgat`: the baselines for Task 2.

use super::{network, options::NetworkOptions};
use crate::{context::Context, error::CliError};
use phase_baselines::{forecasting::SETTINGS, nodes::Nodes, social_lstm::SocialLstm, stgat::Stgat};

/// Trains a Social-LSTM.
///
/// # Errors
/// Those of [`network::run`].
pub(super) fn social_lstm(options: &NetworkOptions, context: &Context) -> Result<(), CliError> {
    network::run::<SocialLstm>(options, context, SETTINGS, |_, observed| Ok(Nodes::of(observed)))
}

/// Trains a spatial-temporal graph attention network.
///
/// # Errors
/// Those of [`network::run`].
pub(super) fn stgat(options: &NetworkOptions, context: &Context) -> Result<(), CliError> {
    network::run::<Stgat>(options, context, SETTINGS, |_, observed| Ok(Nodes::of(observed)))
}
