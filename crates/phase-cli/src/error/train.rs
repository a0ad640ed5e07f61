//! Every way in which training can fail, and its exit code.

use phase_baselines::{
    recognition::LabelError,
    strength,
    training::{CheckpointError, NetworkError, RecordError, TrainingError},
};
use phase_dataset::{FileError, WriteError};
use phase_event::ObservedError;
use phase_simple::strength::WeightsError;
use std::path::PathBuf;
use thiserror::Error;

/// Why a command failed. The text is one plain sentence.
#[derive(Debug, Error)]
pub enum TrainError {
    /// A file of the dataset cannot be used.
    #[error(transparent)]
    File(#[from] FileError),
    /// The folder is no finished dataset.
    #[error("{}: is no finished dataset; give a folder with manifest.json", .0.display())]
    NotADataset(PathBuf),
    /// The dataset has no events to learn from, or none to validate on.
    #[error("{}: has no {split} events", folder.display())]
    NoEvents {
        /// The dataset.
        folder: PathBuf,
        /// What it lacks.
        split: &'static str,
    },
    /// The dataset has fewer events to learn from than are asked for.
    #[error("{}: has {found} train events, fewer than the {asked} of --events", folder.display())]
    TooFewEvents {
        /// The dataset.
        folder: PathBuf,
        /// How many are asked for.
        asked: usize,
        /// How many it has.
        found: usize,
    },
    /// A file does not hold the event it should.
    #[error("{}: has no event {id:?}", file.display())]
    UnknownId {
        /// The file.
        file: PathBuf,
        /// What the manifest says is in it.
        id: String,
    },
    /// An event cannot be looked at.
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
    /// An event has a label that networks do not know.
    #[error("event {id}: {source}")]
    Label {
        /// The event.
        id: String,
        /// Why.
        source: LabelError,
    },
    /// What was kept of a training cannot be used.
    #[error("{}: {source}; give the options of that training, choose another file or remove this one", file.display())]
    Checkpoint {
        /// The file.
        file: PathBuf,
        /// Why.
        source: CheckpointError,
    },
    /// The record of a training that was broken off cannot be used.
    #[error("{}: {source}; remove {} to begin anew", file.display(), checkpoint.display())]
    Record {
        /// The file.
        file: PathBuf,
        /// What the training would go on from.
        checkpoint: PathBuf,
        /// Why.
        source: RecordError,
    },
    /// No strengths could be learnt.
    #[error(transparent)]
    Strength(#[from] strength::TrainingError),
    /// Nothing could be learnt.
    #[error(transparent)]
    Training(#[from] TrainingError),
    /// What was learnt cannot be kept.
    #[error("the weights: {0}")]
    Network(#[from] NetworkError),
    /// What was learnt cannot be kept.
    #[error("the weights: {0}")]
    Weights(#[from] WeightsError),
}

impl TrainError {
    /// 2 for something about the dataset or the output file, 1 for everything else.
    #[must_use]
    pub const fn exit_code(&self) -> u8 {
        match self {
            Self::File(_)
            | Self::NotADataset(_)
            | Self::NoEvents { .. }
            | Self::TooFewEvents { .. }
            | Self::UnknownId { .. }
            | Self::Observed { .. }
            | Self::Label { .. }
            | Self::Checkpoint { .. }
            | Self::Record { .. }
            | Self::Output(_) => 2,
            Self::Strength(_) | Self::Training(_) | Self::Network(_) | Self::Weights(_) => 1,
        }
    }
}
