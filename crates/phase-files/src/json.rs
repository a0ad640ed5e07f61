//! Files of JSON.

use crate::{FileError, Problem};
use phase_model::json::parse;
use serde_json::Value;
use std::path::Path;

/// Reads a whole file as JSON.
///
/// # Errors
/// Any of [`Problem::IsFolder`], [`Problem::Unreadable`] and [`Problem::Json`].
pub fn read(path: &Path) -> Result<Value, FileError> {
    parse(&bytes(path)?).map_err(|error| FileError { file: path.to_owned(), problem: error.into() })
}

/// Reads a whole file, whatever its contents.
///
/// # Errors
/// [`Problem::IsFolder`] or [`Problem::Unreadable`].
pub fn bytes(path: &Path) -> Result<Vec<u8>, FileError> {
    let fail = |problem| FileError { file: path.to_owned(), problem };
    if path.is_dir() {
        return Err(fail(Problem::IsFolder));
    }
    std::fs::read(path).map_err(|error| fail(Problem::Unreadable(error)))
}
