//! Every way in which training can fail.

use super::Fault;
use phase_baselines::{
    intent_network::UnknownHypothesis,
    recognition::LabelError,
    strength,
    training::{CheckpointError, NetworkError, TrainingError, TrainingRecordError},
};
use phase_event::{MethodError, ObservedError};
use phase_files::{FileError, WriteError};
use phase_model::json::FieldError;
use phase_pomcp::PomcpError;
use phase_simple::strength::WeightsError;
use std::path::PathBuf;
use thiserror::Error;

/// Why a training failed. The text is one plain sentence.
#[derive(Debug, Error)]
pub enum TrainError {
    /// A file of the dataset cannot be used.
    #[error(transparent)]
    File(#[from] FileError),
    /// The folder is not a finished dataset.
    #[error("{}: is not a finished dataset; give a folder with manifest.json", .0.display())]
    NotADataset(PathBuf),
    /// The dataset has no training events, or no validation events.
    #[error("{}: has no {split} events; datasets of the preset phase-500 have", folder.display())]
    NoEvents {
        /// The dataset.
        folder: PathBuf,
        /// Name of the split that it lacks.
        split: &'static str,
    },
    /// The dataset has fewer training events than requested.
    #[error("{}: has {found} train events, fewer than the {asked} of --events", folder.display())]
    TooFewEvents {
        /// The dataset.
        folder: PathBuf,
        /// The number requested.
        asked: usize,
        /// The number available.
        found: usize,
    },
    /// A file does not contain the event it should.
    #[error("{}: has no event {id:?}", file.display())]
    UnknownId {
        /// The file.
        file: PathBuf,
        /// The event according to the manifest.
        id: String,
    },
    /// An event cannot be used.
    #[error("event {id}: {source}")]
    Observed {
        /// The event.
        id: String,
        /// Why.
        source: ObservedError,
    },
    /// The weights cannot be written.
    #[error(transparent)]
    Output(#[from] WriteError),
    /// An event has a label without a class in the networks.
    #[error("event {id}: {source}")]
    Label {
        /// The event.
        id: String,
        /// Why.
        source: LabelError,
    },
    /// An event has labels that the intent network does not consider.
    #[error("event {id}: {source}")]
    Hypothesis {
        /// The event.
        id: String,
        /// Why.
        source: UnknownHypothesis,
    },
    /// An event has no searches by our own minds.
    #[error("event {id}: must be simulated by phase minds, whose searches are to be learnt")]
    NoThoughts {
        /// The event.
        id: String,
    },
    /// Nobody knows the beliefs of an event's agents.
    #[error("event {id}: {source}")]
    Beliefs {
        /// The event.
        id: String,
        /// Why.
        source: MethodError,
    },
    /// The settings of an event cannot be read.
    #[error("event {id}: {source}")]
    Settings {
        /// The event.
        id: String,
        /// Why.
        source: FieldError,
    },
    /// A search failed.
    #[error("event {id}: {source}")]
    Search {
        /// The event.
        id: String,
        /// Why.
        source: PomcpError,
    },
    /// The checkpoint of a training cannot be used.
    #[error("{}: {source}; give the options of that training, choose another file or remove this one", file.display())]
    Checkpoint {
        /// The file.
        file: PathBuf,
        /// Why.
        source: CheckpointError,
    },
    /// The record of an interrupted training cannot be used.
    #[error("{}: {source}; remove {} to begin anew", file.display(), checkpoint.display())]
    TrainingRecord {
        /// The file.
        file: PathBuf,
        /// File from which the training would resume.
        checkpoint: PathBuf,
        /// Why.
        source: TrainingRecordError,
    },
    /// Training of the strength regressor failed.
    #[error(transparent)]
    Strength(#[from] strength::TrainingError),
    /// Training of a network failed.
    #[error(transparent)]
    Training(#[from] TrainingError),
    /// The trained weights cannot be saved.
    #[error("the weights: {0}")]
    Network(#[from] NetworkError),
    /// The trained weights cannot be saved.
    #[error("the weights: {0}")]
    Weights(#[from] WeightsError),
}

impl TrainError {
    /// Thing that has to change for the training to succeed.
    #[must_use]
    pub const fn fault(&self) -> Fault {
        match self {
            Self::File(_)
            | Self::NotADataset(_)
            | Self::NoEvents { .. }
            | Self::TooFewEvents { .. }
            | Self::UnknownId { .. }
            | Self::Observed { .. }
            | Self::NoThoughts { .. }
            | Self::Beliefs { .. }
            | Self::Settings { .. }
            | Self::Search { .. }
            | Self::Label { .. }
            | Self::Hypothesis { .. }
            | Self::Checkpoint { .. }
            | Self::TrainingRecord { .. }
            | Self::Output(_) => Fault::Input,
            Self::Strength(_) | Self::Training(_) | Self::Network(_) | Self::Weights(_) => Fault::Run,
        }
    }
}
