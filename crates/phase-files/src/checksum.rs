//! Sizes and SHA-256 checksums of files.

use crate::{FileError, Problem, regular};
use phase_model::path::RelativePath;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::{
    fmt::Write as _,
    fs::File,
    io::{self, Read},
    path::Path,
};

/// A file as a list of files has it: path, size and checksum.
///
/// The path is relative to the folder of the list and never leads out of it, so a list from elsewhere cannot
/// make a program read other files.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileEntry {
    /// Path relative to the dataset's folder, with `/`.
    pub path: RelativePath,
    /// Size (bytes).
    pub bytes: u64,
    /// SHA-256 of the contents, in lower-case hexadecimal.
    pub sha256: String,
}

impl FileEntry {
    /// Measures a file of a folder.
    ///
    /// # Errors
    /// [`Problem::Path`] if the path is none inside a folder, [`Problem::Unreadable`] or [`Problem::NoFile`].
    pub fn of(folder: &Path, path: impl Into<String>) -> Result<Self, FileError> {
        let path = path.into();
        let named = RelativePath::new(path.as_str());
        named
            .map_err(|rule| FileError { file: folder.join(path), problem: Problem::Path(rule) })
            .and_then(|path| Self::measure(folder, path))
    }

    fn measure(folder: &Path, path: RelativePath) -> Result<Self, FileError> {
        let file = path.below(folder);
        match digest(&file) {
            Ok((bytes, sha256)) => Ok(Self { path, bytes, sha256 }),
            Err(problem) => Err(FileError { file, problem }),
        }
    }

    /// The path of the file, whose own is relative to a folder.
    #[must_use]
    pub fn place(&self, folder: &Path) -> std::path::PathBuf {
        self.path.below(folder)
    }

    /// Checks that the file is unchanged.
    ///
    /// # Errors
    /// [`Problem::Unreadable`] if it is gone, [`Problem::NoFile`] if it is something else,
    /// [`Problem::Altered`] if it differs.
    pub fn verify(&self, folder: &Path) -> Result<(), FileError> {
        let found = Self::measure(folder, self.path.clone())?;
        if found == *self {
            Ok(())
        } else {
            let what = if found.bytes == self.bytes { "checksum" } else { "size" };
            Err(FileError { file: self.place(folder), problem: Problem::Altered(what) })
        }
    }
}

/// SHA-256 of bytes.
#[must_use]
pub fn sha256(bytes: &[u8]) -> [u8; 32] {
    Sha256::digest(bytes).into()
}

/// SHA-256 of bytes, in lower-case hexadecimal.
#[must_use]
pub fn sha256_hex(bytes: &[u8]) -> String {
    hexadecimal(&sha256(bytes))
}

/// Bytes in lower-case hexadecimal.
#[must_use]
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::with_capacity(2 * bytes.len()), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// Size and checksum.
fn digest(path: &Path) -> Result<(u64, String), Problem> {
    match regular::open(path) {
        Ok(file) => digest_of(file).map_err(Problem::Unreadable),
        Err(FileError { problem: Problem::IsFolder, .. }) => Err(Problem::NoFile),
        Err(error) => Err(error.problem),
    }
}

fn digest_of(mut file: File) -> io::Result<(u64, String)> {
    let mut hasher = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    let mut bytes = 0;
    loop {
        let read = file.read(&mut buffer)?;
        if read == 0 {
            return Ok((bytes, hexadecimal(&hasher.finalize())));
        }
        hasher.update(&buffer[..read]);
        bytes += read as u64;
    }
}
