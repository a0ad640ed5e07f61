//! What can be wrong with a file, in one plain sentence each.

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
    pub problem: Problem,
}

/// What is wrong with a file, without its name.
#[derive(Clone, PartialEq, Debug, Error)]
pub enum Problem {
    /// It cannot be opened or read.
    #[error("cannot be read: {0}")]
    Unreadable(String),
    /// It is a folder.
    #[error("is a folder; a file is needed")]
    IsFolder,
    /// It holds nothing.
    #[error("is empty")]
    Empty,
    /// It is not text at all: a picture, a video, an archive.
    #[error("is not JSON text (byte {0} is no UTF-8)")]
    NotText(usize),
    /// It is text but not JSON.
    #[error("is not JSON: {what} in line {line}")]
    NotJson {
        /// What stands there.
        what: String,
        /// Line of the mistake, from 1.
        line: usize,
    },
    /// It ends in the middle.
    #[error("is truncated: the JSON ends unfinished in line {0}")]
    Truncated(usize),
    /// A number is written as NaN or an infinity.
    #[error("holds {token} in line {line}: numbers must be finite")]
    NotANumber {
        /// What stands there.
        token: String,
        /// Line, from 1.
        line: usize,
    },
    /// A number is too large to be one.
    #[error("holds a number in line {0} that is too large: numbers must be finite")]
    NumberTooLarge(usize),
    /// It is JSON of another kind.
    #[error("field `format` must be {expected:?}, {found}")]
    Format {
        /// What it must be.
        expected: &'static str,
        /// What it is, in words.
        found: String,
    },
    /// It is JSON of the right format, but some of it is missing or of the wrong type.
    #[error("is no complete {what}: {rule}")]
    Shape {
        /// What it should be.
        what: &'static str,
        /// What is wrong.
        rule: String,
    },
    /// Its size or checksum is not the one in the manifest.
    #[error("differs in {0} from what its manifest says")]
    Altered(&'static str),
    /// It is no Parquet file, or a damaged one.
    #[error("is no whole Parquet file: {0}")]
    Parquet(String),
    /// A Parquet file says something else than the event's own file or the manifest.
    #[error("event {event}: column `{column}` differs from the event's own file or the manifest")]
    Disagrees {
        /// The event's `id`.
        event: String,
        /// The first column that differs.
        column: &'static str,
    },
    /// A manifest names a path that leads out of its folder.
    #[error("lies outside of the dataset's folder")]
    OutsideFolder,
    /// A finished dataset must have it, but its manifest does not name it.
    #[error("is not in the manifest, but every dataset has it")]
    Unlisted,
    /// It lies in a dataset's folder, but the manifest does not name it.
    #[error("is not in the manifest")]
    Extra,
    /// The manifest names it, but there are no events for it.
    #[error("is in the manifest, but none of its events belongs into it")]
    Eventless,
    /// A manifest names a file twice.
    #[error("names {0} more than once")]
    DuplicatePath(String),
    /// There is nothing in it to work on.
    #[error("field `events` must hold at least one event")]
    NoEvents,
    /// Two events have the same name.
    #[error("event {0}: field `id` must differ from that of every other event")]
    DuplicateId(String),
    /// A field breaks a rule.
    #[error("{}{problem}", event_prefix(event))]
    Field {
        /// The event it belongs to, by its `id` or its number.
        event: Option<String>,
        /// The field and the rule.
        problem: FieldError,
    },
    /// A field breaks a rule of [`phase_model::validate`] or [`phase_model::layout`], whose text names both.
    #[error("event {event}: {rule}")]
    Scene {
        /// The event's `id` or number.
        event: String,
        /// The field and the rule.
        rule: String,
    },
}

/// A field that breaks a rule.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
#[error("{}{rule}", field_prefix(field))]
pub struct FieldError {
    /// Where in the file, such as `agents[0].radius`; empty for the file or event as a whole.
    pub field: String,
    /// What it breaks, such as `must be a finite number, not null`.
    pub rule: String,
}

/// A file or folder that cannot be written. The text names it first.
#[derive(Debug, Error)]
#[error("{}: cannot {action}: {}", path.display(), plain_reason(source))]
pub struct WriteError {
    /// The file or folder.
    pub path: PathBuf,
    /// What was tried, such as `write the file`.
    pub action: &'static str,
    /// The system's answer.
    #[source]
    pub source: io::Error,
}

impl WriteError {
    /// A file whose contents cannot be written as JSON.
    #[must_use]
    pub fn json(path: &Path, error: serde_json::Error) -> Self {
        Self { path: path.to_owned(), action: "encode the file as JSON", source: error.into() }
    }
}

/// The system's answer in words, without its number.
#[must_use]
pub fn plain_reason(error: &io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or_default().to_lowercase()
}

fn field_prefix(field: &str) -> String {
    if field.is_empty() { String::new() } else { format!("field `{field}` ") }
}

fn event_prefix(event: &Option<String>) -> String {
    event.as_ref().map_or_else(String::new, |event| format!("event {event}: "))
}
