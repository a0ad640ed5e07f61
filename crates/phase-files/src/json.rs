//! Files of JSON.

use crate::{FileError, Problem, regular};
use phase_model::json::{check_format, parse, read_as};
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::path::Path;

/// Reads a whole file as JSON.
///
/// # Errors
/// Those of [`bytes`], and [`Problem::Json`].
pub fn read(path: &Path) -> Result<Value, FileError> {
    parse(&bytes(path)?).map_err(|error| FileError { file: path.to_owned(), problem: error.into() })
}

/// Reads a file of one of our formats, by the name in its field `format`; `what` names the kind of file in
/// messages.
///
/// # Errors
/// Those of [`read`], those of [`check_format`], and [`Problem::Incomplete`] with the field and its rule.
pub fn read_format<T: DeserializeOwned>(
    path: &Path,
    format: &'static str,
    what: &'static str,
) -> Result<T, FileError> {
    let fail = |problem| FileError { file: path.to_owned(), problem };
    let value = read(path)?;
    check_format(&value, format).map_err(|error| fail(error.into()))?;
    read_as(value).map_err(|source| fail(Problem::Incomplete { what, source }))
}

/// Reads a whole file, whatever its contents; see [`regular::bytes`].
///
/// # Errors
/// [`Problem::IsFolder`], [`Problem::NoFile`], [`Problem::TooLarge`] or [`Problem::Unreadable`].
pub fn bytes(path: &Path) -> Result<Vec<u8>, FileError> {
    regular::bytes(path)
}
