//! Errors of files: each names the file and says in one plain sentence what is wrong with it.

use phase_model::{foreign, json::JsonError, path::PathError};
use std::{
    io,
    path::{Path, PathBuf},
};
use thiserror::Error;

/// A file that cannot be used, and why. The text names the file first.
#[derive(Debug, Error)]
#[error("{}: {problem}", shown(file))]
pub struct FileError {
    /// The file.
    pub file: PathBuf,
    /// The problem, which does not name the file.
    #[source]
    pub problem: Problem,
}

/// A problem with a file, in words that do not name the file.
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
    /// It breaks a rule of its own format, whose reader says which.
    #[error(transparent)]
    Content(Box<dyn core::error::Error + Send + Sync>),
    /// It is JSON of the right format, but some of it is missing, unknown or of the wrong type.
    #[error("is no complete {what}: {}", foreign::sentence(&source.to_string()))]
    Incomplete {
        /// The kind of file that was expected, such as `dataset manifest`.
        what: &'static str,
        /// The reader's own words, with line and column.
        source: serde_json::Error,
    },
    /// It is JSON of the right format and complete, but its parts do not agree.
    #[error("is not a complete {what}: {rule}")]
    Shape {
        /// The kind of file that was expected, such as `list of splits`.
        what: &'static str,
        /// The rule that the file breaks.
        rule: String,
    },
    /// Its size or checksum is not the one in the manifest.
    #[error("differs in {0} from what its manifest says")]
    Altered(&'static str),
    /// It is not a regular file, but a folder, a pipe or something else.
    #[error("is not a file")]
    NoFile,
    /// It is larger than files of its kind are.
    #[error("is larger than {largest} bytes")]
    TooLarge {
        /// The largest file that is read (bytes).
        largest: u64,
    },
    /// It is a link, which may stand for different files at different times.
    #[error("is a link; a dataset holds files")]
    Link,
    /// It is not what follows from other files.
    #[error("differs from {0}")]
    Differs(String),
    /// Its path is none that a file may have.
    #[error("{0}")]
    Path(#[source] PathError),
}

/// A file or folder that cannot be written. The text names it first.
#[derive(Debug, Error)]
#[error("{}: cannot {action}: {}", shown(path), plain_reason(source))]
pub struct WriteError {
    /// The file or folder.
    pub path: PathBuf,
    /// The operation that failed, such as `write the file`.
    pub action: &'static str,
    /// The system's error.
    #[source]
    pub source: io::Error,
}

impl Problem {
    /// A broken rule of the file's own format.
    #[must_use]
    pub fn content(error: impl core::error::Error + Send + Sync + 'static) -> Self {
        Self::Content(Box::new(error))
    }
}

impl WriteError {
    /// A file whose contents cannot be written as JSON.
    #[must_use]
    pub fn json(path: &Path, error: serde_json::Error) -> Self {
        Self { path: path.to_owned(), action: "encode the file as JSON", source: error.into() }
    }

    /// Whether the disk is full or its quota exceeded: no fault of whoever chose the place.
    #[must_use]
    pub fn is_full(&self) -> bool {
        matches!(self.source.kind(), io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded)
    }
}

/// A path for a message. Others may have named what is there, in any bytes.
#[must_use]
pub fn shown(path: &Path) -> String {
    foreign::sentence(&path.to_string_lossy()).into_owned()
}

/// A path as results for programs have it: as text, in which bytes that are none are U+FFFD. A file is never
/// looked for under it.
#[must_use]
pub fn told(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

/// Serialises a path as [`told`]: by itself one that is no text has no form in JSON.
///
/// # Errors
/// Those of the serialiser.
pub fn serialize_told<S: serde::Serializer>(path: &Path, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&path.to_string_lossy())
}

/// The system's error message without its number.
#[must_use]
pub fn plain_reason(error: &io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or_default().to_lowercase()
}
