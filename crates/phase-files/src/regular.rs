//! Regular files, the only ones that are read: a pipe may wait for ever, and a device may never end.

use crate::{FileError, Problem};
use std::{
    fs::{self, File},
    io::Read,
    path::Path,
};

/// Largest file that is read whole (bytes). Files of events, weights and videos are far smaller; tables that
/// are larger are read in parts.
pub const LARGEST_BYTES: u64 = 1 << 30;

/// Opens a regular file, or a link to one, for reading.
///
/// # Errors
/// [`Problem::IsFolder`], [`Problem::NoFile`] or [`Problem::Unreadable`].
pub fn open(path: &Path) -> Result<File, FileError> {
    let fail = |problem| FileError { file: path.to_owned(), problem };
    // Looked at before it is opened, which may already wait.
    let about = fs::metadata(path).map_err(|error| fail(Problem::Unreadable(error)))?;
    if about.is_dir() {
        return Err(fail(Problem::IsFolder));
    }
    if !about.is_file() {
        return Err(fail(Problem::NoFile));
    }
    let file = File::open(path).map_err(|error| fail(Problem::Unreadable(error)))?;
    let about = file.metadata().map_err(|error| fail(Problem::Unreadable(error)))?;
    if about.is_file() { Ok(file) } else { Err(fail(Problem::NoFile)) }
}

/// Reads a whole regular file of at most [`LARGEST_BYTES`].
///
/// # Errors
/// Those of [`open`], and [`Problem::TooLarge`].
pub fn bytes(path: &Path) -> Result<Vec<u8>, FileError> {
    bytes_within(path, LARGEST_BYTES)
}

/// Reads a whole regular file of at most so many bytes.
///
/// # Errors
/// Those of [`open`], and [`Problem::TooLarge`].
pub fn bytes_within(path: &Path, largest: u64) -> Result<Vec<u8>, FileError> {
    let fail = |problem| FileError { file: path.to_owned(), problem };
    let file = open(path)?;
    let length = file.metadata().map_err(|error| fail(Problem::Unreadable(error)))?.len();
    let mut bytes = Vec::new();
    if length <= largest {
        bytes.reserve_exact(usize::try_from(length).unwrap_or_default());
        // It may grow meanwhile.
        let read = file.take(largest + 1).read_to_end(&mut bytes);
        read.map_err(|error| fail(Problem::Unreadable(error)))?;
    }
    if length > largest || bytes.len() as u64 > largest {
        return Err(fail(Problem::TooLarge { largest }));
    }
    Ok(bytes)
}

/// Reads a whole regular file of text.
///
/// # Errors
/// Those of [`bytes`], and [`Problem::Json`] for what is no text.
pub fn text(path: &Path) -> Result<String, FileError> {
    String::from_utf8(bytes(path)?).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        FileError { file: path.to_owned(), problem: phase_model::json::JsonError::NotText(at).into() }
    })
}
