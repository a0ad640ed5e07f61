//! Files of JSON.

use crate::{FileError, regular};
use phase_model::json::parse;
use serde_json::Value;
use std::path::Path;

/// Reads a whole file as JSON.
///
/// # Errors
/// Those of [`bytes`], and [`Problem::Json`](crate::Problem::Json).
pub fn read(path: &Path) -> Result<Value, FileError> {
    parse(&bytes(path)?).map_err(|error| FileError { file: path.to_owned(), problem: error.into() })
}

/// Reads a whole file, whatever its contents; see [`regular::bytes`].
///
/// # Errors
/// [`Problem::IsFolder`](crate::Problem::IsFolder), [`Problem::NoFile`](crate::Problem::NoFile),
/// [`Problem::TooLarge`](crate::Problem::TooLarge) or [`Problem::Unreadable`](crate::Problem::Unreadable).
pub fn bytes(path: &Path) -> Result<Vec<u8>, FileError> {
    regular::bytes(path)
}
