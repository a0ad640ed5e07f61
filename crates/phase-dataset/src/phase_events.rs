//! Files of the format `phase-events/1`.

use phase_event::{EventReadError, Recording};
use phase_files::{FileError, Problem, json};
use std::path::Path;

/// Reads all events of a `phase-events/1` file and checks each.
///
/// # Errors
/// A [`FileError`] that names file, event, field and rule.
pub fn read(path: &Path) -> Result<Vec<Recording>, FileError> {
    let events = phase_event::parse(&json::bytes(path)?);
    events.map_err(|error| {
        let problem = match error {
            EventReadError::Json(error) => error.into(),
            error => Problem::content(error),
        };
        FileError { file: path.to_owned(), problem }
    })
}
