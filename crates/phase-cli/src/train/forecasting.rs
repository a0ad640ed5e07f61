//! `social-lstm` and `stgat`: the baselines for Task 2.

use super::{error::TrainError, network, options::NetworkOptions};
use phase_baselines::{forecasting::SETTINGS, nodes::Nodes, social_lstm::SocialLstm, stgat::Stgat};

/// Trains a Social-LSTM.
///
/// # Errors
/// Those of [`network::run`].
pub(super) fn social_lstm(options: &NetworkOptions) -> Result<(), TrainError> {
    network::run::<SocialLstm>(options, SETTINGS, |_, observed| Ok(Nodes::of(observed)))
}

/// Trains a spatial-temporal graph attention network.
///
/// # Errors
/// Those of [`network::run`].
pub(super) fn stgat(options: &NetworkOptions) -> Result<(), TrainError> {
    network::run::<Stgat>(options, SETTINGS, |_, observed| Ok(Nodes::of(observed)))
}
