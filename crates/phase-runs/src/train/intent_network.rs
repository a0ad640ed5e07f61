//! `intent-network`: SIMPLE's learnt guess at intents.

use super::{network, options::NetworkOptions};
use crate::error::train::TrainError;
use crate::{context::Context, error::CliError};
use phase_baselines::intent_network::{IntentNetwork, LabelledIntents, SETTINGS};
use phase_event::{ObservedEvent, Recording};

/// Trains an intent network.
///
/// # Errors
/// Those of [`network::run`].
pub(super) fn run(options: &NetworkOptions, context: &Context) -> Result<(), CliError> {
    network::run::<IntentNetwork>(options, context, SETTINGS, sample)
}

fn sample(recording: &Recording, observed: &ObservedEvent) -> Result<LabelledIntents, TrainError> {
    LabelledIntents::new(observed, recording.scene.goals(), recording.scene.attitudes())
        .map_err(|source| TrainError::Hypothesis { id: recording.id.clone(), source })
}
