//! Sizes and SHA-256 checksums of files.

use crate::{FileError, Problem};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::{
    fmt::Write as _,
    fs::File,
    io::{self, Read},
    path::{Component, Path},
};

/// A file of a dataset as listed in its manifest.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileEntry {
    /// Path relative to the dataset's folder, with `/`.
    pub path: String,
    /// Size (bytes).
    pub bytes: u64,
    /// SHA-256 of the contents, in lower-case hexadecimal.
    pub sha256: String,
}

impl FileEntry {
    /// Measures a file of a folder.
    ///
    /// # Errors
    /// [`Problem::Unreadable`].
    pub fn of(folder: &Path, path: impl Into<String>) -> Result<Self, FileError> {
        let path = path.into();
        let file = folder.join(&path);
        let (bytes, sha256) =
            digest(&file).map_err(|error| FileError { problem: Problem::Unreadable(error), file })?;
        Ok(Self { path, bytes, sha256 })
    }

    /// Checks that the file is unchanged.
    ///
    /// # Errors
    /// [`Problem::Unreadable`] if it is gone, [`Problem::Altered`] if it differs, [`Problem::OutsideFolder`] if
    /// its path leads out of the folder.
    pub fn verify(&self, folder: &Path) -> Result<(), FileError> {
        let file = folder.join(&self.path);
        let plain = |part: Component<'_>| matches!(part, Component::Normal(_));
        if self.path.is_empty() || !Path::new(&self.path).components().all(plain) {
            return Err(FileError { file, problem: Problem::OutsideFolder });
        }
        let found = Self::of(folder, self.path.clone())?;
        if found == *self {
            Ok(())
        } else {
            let what = if found.bytes == self.bytes { "checksum" } else { "size" };
            Err(FileError { file, problem: Problem::Altered(what) })
        }
    }
}

/// SHA-256 of bytes.
#[must_use]
pub fn sha256(bytes: &[u8]) -> [u8; 32] {
    Sha256::digest(bytes).into()
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

fn digest(path: &Path) -> io::Result<(u64, String)> {
    let mut file = File::open(path)?;
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
