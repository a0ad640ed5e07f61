//! `two-level-lstm`, `arg` and `socialgnn`: the baselines for Task 1.

use super::{network, options::NetworkOptions};
use crate::error::train::TrainError;
use crate::{context::Context, error::CliError};
use phase_baselines::{
    arg::Arg,
    recognition::{LabelledEvent, SETTINGS},
    social_gnn::{self, SocialGnn},
    two_level_lstm::TwoLevelLstm,
};
use phase_event::{ObservedEvent, Recording};

/// Trains a 2-Level LSTM.
///
/// # Errors
/// Those of [`network::run`].
pub(super) fn two_level_lstm(options: &NetworkOptions, context: &Context) -> Result<(), CliError> {
    network::run::<TwoLevelLstm>(options, context, SETTINGS, sample)
}

/// Trains an actor relation graph.
///
/// # Errors
/// Those of [`network::run`].
pub(super) fn arg(options: &NetworkOptions, context: &Context) -> Result<(), CliError> {
    network::run::<Arg>(options, context, SETTINGS, sample)
}

/// Trains a SocialGNN.
///
/// # Errors
/// Those of [`network::run`].
pub(super) fn social_gnn(options: &NetworkOptions, context: &Context) -> Result<(), CliError> {
    network::run::<SocialGnn>(options, context, social_gnn::SETTINGS, sample)
}

fn sample(recording: &Recording, observed: &ObservedEvent) -> Result<LabelledEvent, TrainError> {
    LabelledEvent::new(observed, recording.scene.goals(), recording.relation)
        .map_err(|source| TrainError::Label { id: recording.id.clone(), source })
}
