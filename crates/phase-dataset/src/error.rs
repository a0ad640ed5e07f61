//! What can be wrong with a file, in one plain sentence each.

use phase_event::EventReadError;
use phase_model::{json::JsonError, path::PathError};
use std::{
    io,
    path::{Path, PathBuf},
};
use thiserror::Error;

/// A file that cannot be used, and why. The text names the file first.
#[derive(Debug, Error)]
#[error("{}: {problem}", file.display())]
pub struct FileError {
    /// The file.
    pub file: PathBuf,
    /// What is wrong with it.
    #[source]
    pub problem: Problem,
}

/// What is wrong with a file, without its name.
#[derive(Debug, Error)]
pub enum Problem {
    /// It cannot be opened or read.
    #[error("cannot be read: {}", plain_reason(.0))]
    Unreadable(#[source] io::Error),
    /// It is a folder.
    #[error("is a folder; a file is needed")]
    IsFolder,
    /// It is not JSON, or JSON of another format.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// An event in it is invalid.
    #[error(transparent)]
    Event(EventReadError),
    /// It is JSON of the right format, but some of it is missing, unknown or of the wrong type.
    #[error("is no complete {what}: {source}")]
    Incomplete {
        /// What it should be.
        what: &'static str,
        /// What is wrong.
        source: serde_json::Error,
    },
    /// It is JSON of the right format and complete, but its parts do not agree.
    #[error("is not a complete {what}: {rule}")]
    Shape {
        /// What it should be.
        what: &'static str,
        /// What is wrong.
        rule: String,
    },
    /// Its size or checksum is not the one in the manifest.
    #[error("differs in {0} from what its manifest says")]
    Altered(&'static str),
    /// It is not a Parquet file, or a damaged one.
    #[error("is not a complete Parquet file: {0}")]
    Parquet(#[source] Box<dyn core::error::Error + Send + Sync>),
    /// It is a Parquet file whose pages are damaged.
    #[error("is no whole Parquet file: its pages cannot be decoded")]
    ParquetPages,
    /// Its contents cannot be converted to JSON, and so cannot be compared with its manifest.
    #[error("cannot be compared with its manifest: {0}")]
    Encode(#[source] serde_json::Error),
    /// A Parquet file contradicts the event's own file or the manifest.
    #[error("event {event}: column `{column}` differs from the event's own file or the manifest")]
    Disagrees {
        /// The event's `id`.
        event: String,
        /// The first column that differs.
        column: &'static str,
    },
    /// It is not a regular file, but a folder, a pipe or something else.
    #[error("is not a file")]
    NoFile,
    /// It is a link, which may stand for different files at different times.
    #[error("is a link; a dataset holds files")]
    Link,
    /// It says what it should, but has other bytes than PHASE writes for that.
    #[error(
        "is not in the form in which it is written: it holds more, or something else, than follows from its contents"
    )]
    Form,
    /// It is not what follows from other files.
    #[error("differs from {0}")]
    Differs(String),
    /// Its path is none that a file may have.
    #[error("{0}")]
    Path(#[source] PathError),
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

/// A file or folder that cannot be written. The text names it first.
#[derive(Debug, Error)]
#[error("{}: cannot {action}: {}", path.display(), plain_reason(source))]
pub struct WriteError {
    /// The file or folder.
    pub path: PathBuf,
    /// The operation that failed, such as `write the file`.
    pub action: &'static str,
    /// The system's error.
    #[source]
    pub source: io::Error,
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

impl WriteError {
    /// A file whose contents cannot be written as JSON.
    #[must_use]
    pub fn json(path: &Path, error: serde_json::Error) -> Self {
        Self { path: path.to_owned(), action: "encode the file as JSON", source: error.into() }
    }
}

/// The system's error message without its number.
#[must_use]
pub fn plain_reason(error: &io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or_default().to_lowercase()
}

impl From<EventReadError> for Problem {
    fn from(error: EventReadError) -> Self {
        match error {
            EventReadError::Json(error) => Self::Json(error),
            error => Self::Event(error),
        }
    }
}
