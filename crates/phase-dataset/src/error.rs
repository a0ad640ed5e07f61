//! Errors of the files of a dataset, one plain sentence each.

use phase_files::{FileError, Problem, WriteError};
use thiserror::Error;

/// A contradiction between a file of a dataset and the rest of it.
#[derive(Debug, Error)]
pub enum DatasetProblem {
    /// Its contents cannot be converted to JSON, and so cannot be compared with its manifest.
    #[error("cannot be compared with its manifest: {0}")]
    Encode(#[source] serde_json::Error),
    /// It says what it should, but has other bytes than PHASE writes for that.
    #[error(
        "is not in the form in which it is written: it holds more, or something else, than follows from its contents"
    )]
    Form,
    /// A finished dataset must have it, but its manifest does not name it.
    #[error("is not in the manifest, but every dataset has it")]
    Unlisted,
    /// It is in a dataset's folder, but the manifest does not name it.
    #[error("is not in the manifest")]
    Extra,
    /// The manifest names it, but there are no events for it.
    #[error("is in the manifest, but none of its events belongs into it")]
    Eventless,
    /// A manifest names a file twice.
    #[error("names {0} more than once")]
    DuplicatePath(String),
}

impl From<DatasetProblem> for Problem {
    fn from(problem: DatasetProblem) -> Self {
        Self::Content(problem.into())
    }
}

/// Why a file that describes a dataset was not written.
#[derive(Debug, Error)]
pub enum ExportError {
    /// A file of an event or a record cannot be read back.
    #[error(transparent)]
    Read(#[from] FileError),
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}
