//! Files of the format `phase-events/1`.

use phase_event::{EventReadError, ObservedEvent, Recording};
use phase_files::{FileError, Problem, json};
use std::path::Path;

/// Reads all events of a `phase-events/1` file and checks each.
///
/// # Errors
/// A [`FileError`] that names file, event, field and rule.
pub fn read(path: &Path) -> Result<Vec<Recording>, FileError> {
    phase_event::parse(&json::bytes(path)?).map_err(|error| failed(path, error))
}

/// Events of a file: with labels, or without.
#[derive(Clone, Debug)]
pub enum Read {
    /// With labels.
    Labelled(Vec<Recording>),
    /// Without labels, by name.
    Unlabelled(Vec<(String, ObservedEvent)>),
}

/// Reads all events of a `phase-events/1` file, whose labels may be absent.
///
/// # Errors
/// A [`FileError`] that names file, event, field and rule.
pub fn read_any(path: &Path) -> Result<Read, FileError> {
    let bytes = json::bytes(path)?;
    let read = if phase_event::is_labelled(&bytes) {
        phase_event::parse(&bytes).map(Read::Labelled)
    } else {
        phase_event::parse_observed(&bytes).map(Read::Unlabelled)
    };
    read.map_err(|error| failed(path, error))
}

fn failed(path: &Path, error: EventReadError) -> FileError {
    let problem = match error {
        EventReadError::Json(error) => error.into(),
        error => Problem::content(error),
    };
    FileError { file: path.to_owned(), problem }
}
