//! Files of the leaderboard, read and written.

use crate::error::RunError;
use phase_files::{FileError, Problem, WriteError, atomic, json};
use phase_model::json::read_as;
use serde::de::DeserializeOwned;
use std::{fs, path::Path};

/// The content of a file, or, if it is not there, of the one that this program has.
pub(super) fn there_or_bundled<T: DeserializeOwned>(file: &Path, text: &str) -> Result<T, RunError> {
    if !file.exists() {
        return bundled(&file.to_string_lossy(), text);
    }
    let value = json::read(file)?;
    read_as(value).map_err(|error| unfit(file, &error.to_string()))
}

/// The content of a file that this program has.
pub(super) fn bundled<T: DeserializeOwned>(name: &str, text: &str) -> Result<T, RunError> {
    serde_json::from_str(text).map_err(|error| unfit(Path::new(name), &error.to_string()))
}

/// A rule that a file breaks.
pub(super) fn unfit(file: &Path, rule: &str) -> RunError {
    let problem = Problem::Shape { what: "file of the leaderboard", rule: rule.into() };
    FileError { file: file.to_owned(), problem }.into()
}

/// Writes a file and the folders on its way.
pub(super) fn write(file: &Path, bytes: &[u8]) -> Result<(), RunError> {
    let folder = file.parent().unwrap_or(Path::new("."));
    let failed = |source| WriteError { path: folder.to_owned(), action: "create the folder", source };
    fs::create_dir_all(folder).map_err(failed).map_err(RunError::Output)?;
    atomic::write(file, bytes).map_err(RunError::Output)
}
