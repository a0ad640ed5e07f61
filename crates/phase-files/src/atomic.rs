//! Files that are complete or absent: written to a temporary file, synced, renamed.

use crate::{WriteError, fault, private, regular};
use serde::Serialize;
use std::{
    ffi::OsString,
    fs::{self, File, OpenOptions, TryLockError},
    io::{self, BufWriter, Write},
    path::{Path, PathBuf},
    sync::atomic::{AtomicU64, Ordering},
};

/// Suffix of files that are still being written.
const PART_SUFFIX: &str = ".part";

/// Writes a file atomically. Folders on the way must exist.
///
/// # Errors
/// If the file cannot be written; then no part of it remains and an older file of this name is unchanged.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let mut file = AtomicFile::create(path)?;
    file.write_all(bytes).map_err(|source| file.failed(source))?;
    file.commit()
}

/// Writes a file as [`write()`] does, for its owner alone; see [`private`].
///
/// # Errors
/// As [`write()`].
pub fn write_private(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let mut file = AtomicFile::create_with(path, private::options())?;
    file.write_all(bytes).map_err(|source| file.failed(source))?;
    file.commit()
}

/// Writes a value atomically as a JSON file with line breaks. Folders on the way must exist.
///
/// # Errors
/// If the value cannot be written as JSON, or as [`write()`].
pub fn write_json(path: &Path, value: &impl Serialize) -> Result<(), WriteError> {
    let text = serde_json::to_string_pretty(value).map_err(|error| WriteError::json(path, error))?;
    write(path, format!("{text}\n").as_bytes())
}

/// Writes a value as JSON on one line, atomically: for files that are large or that only programs read.
///
/// # Errors
/// If the value has no form in JSON, or the file cannot be written.
pub fn write_json_line(path: &Path, value: &impl Serialize) -> Result<(), WriteError> {
    let text = serde_json::to_string(value).map_err(|error| WriteError::json(path, error))?;
    write(path, format!("{text}\n").as_bytes())
}

/// Removes the temporary files of a file that programs have left which were killed while they wrote it. Those
/// that are being written are locked, and stay.
pub fn remove_abandoned(path: &Path) {
    for part in parts_of(path) {
        if let Ok(file) = regular::open(&part)
            && file.try_lock().is_ok()
        {
            // One that cannot be removed is harmless. It stays locked meanwhile, so that nobody takes it for
            // its own.
            let _ = fs::remove_file(&part);
        }
    }
}

/// The files and folders that have temporary names of a file or folder, see [`part_path`].
pub(crate) fn parts_of(path: &Path) -> Vec<PathBuf> {
    let Some((folder, name)) = path.parent().zip(path.file_name()) else { return Vec::new() };
    let listed = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let begin = format!(".{}.", name.to_string_lossy());
    let entries = fs::read_dir(listed).into_iter().flatten().flatten().map(|entry| entry.file_name());
    let parts = entries.filter(|part| {
        let part = part.to_string_lossy();
        let numbers = part.strip_prefix(&begin).and_then(|rest| rest.strip_suffix(PART_SUFFIX));
        numbers.is_some_and(|it| it.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.'))
    });
    parts.map(|part| folder.join(part)).collect()
}

/// Removes a file if it exists.
///
/// # Errors
/// If it exists and cannot be removed.
pub fn remove(path: &Path) -> Result<(), WriteError> {
    match fault::step().and_then(|()| fs::remove_file(path)) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => {
            Err(WriteError { path: path.to_owned(), action: "remove the file", source })
        }
        _ => Ok(()),
    }
}

/// A file that appears under its name only when it is finished.
///
/// Bytes go to a hidden file beside it, which [`AtomicFile::commit`] syncs and renames. If the file is
/// dropped before, or the program ends, nothing is left under the name, and an older file of this name is
/// unchanged.
#[derive(Debug)]
pub struct AtomicFile {
    path: PathBuf,
    part: PathBuf,
    writer: Option<BufWriter<File>>,
}

impl AtomicFile {
    /// Creates the temporary file beside the path under which it is to appear.
    ///
    /// # Errors
    /// If no file can be created there, or something else than a regular file has its name: to a device or a
    /// pipe nothing is written whole or not at all, and a file in its place would take it from all others.
    pub fn create(path: &Path) -> Result<Self, WriteError> {
        Self::create_with(path, OpenOptions::new())
    }

    fn create_with(path: &Path, options: OpenOptions) -> Result<Self, WriteError> {
        let created =
            replaceable(path).and_then(|()| fault::step()).and_then(|()| create_locked(path, options));
        match created {
            Ok((part, file)) => Ok(Self { path: path.to_owned(), part, writer: Some(BufWriter::new(file)) }),
            Err(source) => Err(error(path, source)),
        }
    }

    /// Syncs the file and gives it its name.
    ///
    /// # Errors
    /// If either fails; then no part of it remains.
    pub fn commit(mut self) -> Result<(), WriteError> {
        self.finish().map_err(|source| error(&self.path, source))
    }

    /// An error about this file for something that went wrong while writing to it.
    #[must_use]
    pub fn failed(&self, source: io::Error) -> WriteError {
        error(&self.path, source)
    }

    fn finish(&mut self) -> io::Result<()> {
        fault::step()?;
        // Open, and so locked, until it has its name: without the lock it would be taken for abandoned.
        let file = self.writer.take().map(BufWriter::into_inner).transpose();
        let file = file.map_err(io::IntoInnerError::into_error)?;
        if let Some(file) = &file {
            file.sync_all()?;
        }
        fault::step()?;
        fs::rename(&self.part, &self.path)?;
        sync_folder(&self.path);
        // Under its name it is there, whatever comes.
        let _ = fault::step();
        Ok(())
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.as_mut().map_or(Ok(0), |writer| writer.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.as_mut().map_or(Ok(()), Write::flush)
    }
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        // After a rename there is nothing to remove, and a failure here cannot be reported.
        let _ = fs::remove_file(&self.part);
    }
}

/// Whether a file name is that of a file still being written.
#[must_use]
pub fn is_part(name: &str) -> bool {
    name.starts_with('.') && name.ends_with(PART_SUFFIX)
}

/// Whether a file may take a name: nothing has it, or a regular file, or a link to one.
fn replaceable(path: &Path) -> io::Result<()> {
    // Standard output may be a regular file, but its name is not that file's.
    let is_descriptor = fs::read_link(path).is_ok_and(|target| target.starts_with("/proc"));
    if is_descriptor || fs::metadata(path).is_ok_and(|about| !about.is_file()) {
        return Err(io::Error::other("what has this name is no regular file"));
    }
    Ok(())
}

/// Creates the temporary file of a path, and locks it. Between its creation and its lock [`remove_abandoned`]
/// can take it for abandoned; then another one is created.
fn create_locked(path: &Path, mut options: OpenOptions) -> io::Result<(PathBuf, File)> {
    options.write(true).create_new(true);
    loop {
        let part = part_path(path);
        // What somebody else has put there is not written to.
        let file = match options.open(&part) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => continue,
            opened => opened?,
        };
        match file.try_lock() {
            // Somebody is removing it.
            Err(TryLockError::WouldBlock) => {}
            Ok(()) if !part.exists() => {}
            // Where there are no locks, nothing is ever taken for abandoned.
            Ok(()) | Err(TryLockError::Error(_)) => return Ok((part, file)),
        }
    }
}

/// A hidden name beside a path. The process number keeps two programs apart. The other number is new each
/// time: whoever has opened a file to see whether it is abandoned must not remove another that has its name
/// by then.
pub(crate) fn part_path(path: &Path) -> PathBuf {
    static FILES: AtomicU64 = AtomicU64::new(0);
    let file = FILES.fetch_add(1, Ordering::Relaxed);
    let mut name = OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{}.{file}{PART_SUFFIX}", std::process::id()));
    path.with_file_name(name)
}

/// Makes the new name last through a power cut, where the system lets one sync a folder.
pub(crate) fn sync_folder(path: &Path) {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    if let Ok(folder) = File::open(folder.unwrap_or_else(|| Path::new("."))) {
        let _ = folder.sync_all();
    }
}

fn error(path: &Path, source: io::Error) -> WriteError {
    WriteError { path: path.to_owned(), action: "write the file", source }
}
