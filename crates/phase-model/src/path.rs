//! Names and paths that come from files: they mean the same on every system, and stay inside their folder.

use core::fmt;
use serde::{Deserialize, Deserializer, Serialize};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Longest path (bytes).
const LONGEST_PATH: usize = 1000;
/// Longest name of a file (bytes), which is the limit of all common file systems.
const LONGEST_NAME: usize = 255;
/// Names that Windows gives to devices, in any case and with any ending; `COM1` to `LPT9` are checked apart.
const DEVICES: [&str; 6] = ["con", "prn", "aux", "nul", "conin$", "conout$"];

/// The reason why a text cannot be the name of a file, or a path inside a folder. The text continues a
/// sentence that begins with its name.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
pub enum PathError {
    /// It is empty or too long.
    #[error("must have 1 to {LONGEST_PATH} bytes, and {LONGEST_NAME} in each name")]
    Length,
    /// It leads out of its folder, or is not in the one form that a path has.
    #[error("must be a relative path with `/` and without `.` and `..`, inside its folder")]
    Outside,
    /// It contains a letter that some systems do not allow.
    #[error("must not contain control characters, `\\` or `:`")]
    Letter,
    /// It ends in a way that some systems do not allow.
    #[error("must not have a name that ends with `.` or a space, which some systems drop")]
    End,
    /// A system takes it for a device.
    #[error("must not have a name that is a device's on some systems, such as `CON` or `nul.json`")]
    Device,
}

/// Checks that a text can be the name of one file on every system.
///
/// # Errors
/// The first rule that is violated.
pub fn check_file_name(name: &str) -> Result<(), PathError> {
    let unusual = |letter: char| letter.is_control() || matches!(letter, '\\' | ':');
    if name.len() > LONGEST_NAME {
        Err(PathError::Length)
    } else if matches!(name, "" | "." | "..") || name.contains('/') {
        Err(PathError::Outside)
    } else if name.contains(unusual) {
        Err(PathError::Letter)
    } else if name.ends_with(['.', ' ']) {
        Err(PathError::End)
    } else if is_device(name) {
        Err(PathError::Device)
    } else {
        Ok(())
    }
}

/// Windows looks at what stands before the first dot.
fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().trim_end().to_ascii_lowercase();
    let mut letters = stem.chars();
    let numbered = matches!(letters.by_ref().take(3).collect::<String>().as_str(), "com" | "lpt")
        && letters.next().is_some_and(|digit| matches!(digit, '1'..='9' | '¹' | '²' | '³'))
        && letters.next().is_none();
    numbered || DEVICES.contains(&stem.as_str())
}

/// A path of a file inside a folder, such as `events/a.json`: relative, with `/`, and without a part that
/// leads elsewhere. A path that a file names is of this type wherever it is used, so that no file can name
/// one outside of its folder.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
#[serde(transparent)]
pub struct RelativePath(String);

impl RelativePath {
    /// Checks a path.
    ///
    /// # Errors
    /// The first rule that is violated.
    pub fn new(path: impl Into<String>) -> Result<Self, PathError> {
        let path = path.into();
        if path.is_empty() || path.len() > LONGEST_PATH {
            return Err(PathError::Length);
        }
        path.split('/').try_for_each(check_file_name)?;
        Ok(Self(path))
    }

    /// The path as a text with `/`.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// The last of its names.
    #[must_use]
    pub fn name(&self) -> &str {
        self.0.rsplit('/').next().unwrap_or_default()
    }

    /// The path of the file, if it is below this folder.
    #[must_use]
    pub fn below(&self, folder: &Path) -> PathBuf {
        let mut path = folder.to_owned();
        path.extend(self.0.split('/'));
        path
    }
}

impl fmt::Display for RelativePath {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(formatter)
    }
}

impl PartialEq<str> for RelativePath {
    fn eq(&self, other: &str) -> bool {
        self.0 == other
    }
}

impl<'de> Deserialize<'de> for RelativePath {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let path = String::deserialize(deserializer)?;
        Self::new(path.clone()).map_err(|rule| serde::de::Error::custom(format!("the path {path:?} {rule}")))
    }
}
