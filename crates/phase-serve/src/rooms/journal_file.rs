//! The journal of a game on disk: `rooms/<name>.jsonl`.

use phase_files::{WriteError, private};
use phase_game::Entry;
use std::{
    fs::{self, File, OpenOptions},
    io::{self, Write as _},
    path::{Path, PathBuf},
    sync::Arc,
};

/// A journal that is being written.
///
/// An entry is with the operating system before anybody sees what it tells, so that nothing is lost if this
/// program is killed; it is forced to the disk at the end of each round, so that a power failure costs the
/// round that is played and nothing else.
#[derive(Debug)]
pub(super) struct JournalFile {
    path: PathBuf,
    file: Arc<File>,
}

impl JournalFile {
    /// The file of a room.
    pub(super) fn path(folder: &Path, room: &str) -> PathBuf {
        folder.join(format!("{room}.jsonl"))
    }

    /// A new journal; the file must not exist.
    pub(super) fn create(folder: &Path, room: &str) -> Result<Self, WriteError> {
        let path = Self::path(folder, room);
        let opened = private::options().append(true).create_new(true).open(&path);
        match opened {
            Ok(file) => Ok(Self { path, file: Arc::new(file) }),
            Err(source) => Err(WriteError { path, action: "create", source }),
        }
    }

    /// A journal that goes on. Of its last line, whose step nobody has seen if it has no end, nothing stays:
    /// only the first `whole` bytes count.
    pub(super) fn reopen(path: &Path, whole: usize) -> Result<Self, WriteError> {
        let failed = |source| WriteError { path: path.to_owned(), action: "continue", source };
        let file = OpenOptions::new().append(true).open(path).map_err(failed)?;
        file.set_len(whole as u64).map_err(failed)?;
        Ok(Self { path: path.to_owned(), file: Arc::new(file) })
    }

    /// Appends an entry. Only this game waits for the disk.
    pub(super) async fn append(&mut self, entry: &Entry) -> Result<(), WriteError> {
        let failed = |source| WriteError { path: self.path.clone(), action: "append to", source };
        let mut line = serde_json::to_vec(entry).map_err(|error| failed(error.into()))?;
        line.push(b'\n');
        // Some bytes into the page cache, which takes microseconds.
        (&*self.file).write_all(&line).map_err(failed)?;
        if matches!(entry, Entry::Step { .. } | Entry::Began { .. }) {
            return Ok(());
        }
        let file = Arc::clone(&self.file);
        let synced = tokio::task::spawn_blocking(move || file.sync_data()).await;
        synced.map_err(io::Error::other).and_then(|synced| synced).map_err(failed)
    }
}

/// The journals of a folder, by name.
pub(super) fn all(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "jsonl") && path.is_file() {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}
