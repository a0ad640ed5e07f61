//! Files that are measured while they are written, for a list of files with their checksums.

use crate::{
    WriteError,
    atomic::AtomicFile,
    checksum::{FileEntry, hexadecimal},
};
use phase_model::path::RelativePath;
use sha2::{Digest, Sha256};
use std::{
    io::{self, Write},
    path::Path,
};

/// Writes a file of a folder atomically, and describes it. `path` is relative to the folder, with `/`.
///
/// # Errors
/// If the file cannot be written, or its path leads out of the folder.
pub fn write(folder: &Path, path: impl Into<String>, bytes: &[u8]) -> Result<FileEntry, WriteError> {
    let mut file = MeasuredFile::create(folder, path)?;
    file.write_all(bytes).map_err(|source| file.failed(source))?;
    file.commit()
}

/// A file of a folder that appears under its name only when it is finished, and is then described.
#[derive(Debug)]
pub struct MeasuredFile {
    file: AtomicFile,
    path: RelativePath,
    hasher: Sha256,
    bytes: u64,
}

impl MeasuredFile {
    /// Begins a file; `path` is relative to the folder, with `/`.
    ///
    /// # Errors
    /// If no file can be created there, or its path leads out of the folder.
    pub fn create(folder: &Path, path: impl Into<String>) -> Result<Self, WriteError> {
        let path = path.into();
        let path = RelativePath::new(path.as_str()).map_err(|rule| WriteError {
            path: folder.join(path),
            action: "write the file",
            source: io::Error::new(io::ErrorKind::InvalidInput, rule),
        })?;
        let file = AtomicFile::create(&path.below(folder))?;
        Ok(Self { file, path, hasher: Sha256::new(), bytes: 0 })
    }

    /// An error about this file for something that went wrong while writing to it.
    #[must_use]
    pub fn failed(&self, source: io::Error) -> WriteError {
        self.file.failed(source)
    }

    /// Describes what has been written so far.
    #[must_use]
    pub fn entry(&self) -> FileEntry {
        let sha256 = hexadecimal(&self.hasher.clone().finalize());
        FileEntry { path: self.path.clone(), bytes: self.bytes, sha256 }
    }

    /// Syncs the file, gives it its name and describes it.
    ///
    /// # Errors
    /// If either fails; then no part of it remains.
    pub fn commit(self) -> Result<FileEntry, WriteError> {
        let entry = self.entry();
        self.file.commit().map(|()| entry)
    }
}

impl Write for MeasuredFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.file.write(bytes)?;
        self.hasher.update(&bytes[..count]);
        self.bytes += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}
