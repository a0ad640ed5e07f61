//! Output folders: which run they belong to, and that only one run at a time writes into them.

use crate::{
    WriteError, atomic,
    error::{plain_reason, shown},
    fault,
    incidental::is_incidental,
    json, private,
    run::{self, RUN_FORMAT, Run},
};
use phase_model::foreign;
use serde_json::Value;
use std::{
    fs::{self, File, OpenOptions, TryLockError},
    io,
    path::{Path, PathBuf},
};
use thiserror::Error;

/// The file that states which run an unfinished folder belongs to.
const MARKER: &str = ".phase-run.json";
/// The file that a running program keeps locked. The system unlocks it however the program ends.
const LOCK: &str = ".phase-lock";
/// Name of the folder of what a run needs again after an interruption.
const CACHE: &str = ".cache";

/// The contents of a folder, as far as they decide whether a run may write into it.
#[derive(Clone, PartialEq, Debug)]
pub enum Contents {
    /// Nothing, or it is not there at all.
    Nothing,
    /// An interrupted run, with its description; see [`Run::check`].
    Unfinished(Value),
    /// A finished run: the file that is written last is present.
    Finished,
}

/// Why a folder cannot be used.
#[derive(Debug, Error)]
pub enum FolderError {
    /// There is a file of this name.
    #[error("{}: is a file; the output needs a folder", shown(.0))]
    IsFile(PathBuf),
    /// It contains files that no run has written.
    #[error(
        "{}: contains other files ({}); choose an empty or a new folder",
        shown(path),
        foreign::name(entry)
    )]
    Foreign {
        /// The folder.
        path: PathBuf,
        /// One of the things in it.
        entry: String,
    },
    /// It cannot be read.
    #[error("{}: cannot be read: {}", shown(path), plain_reason(source))]
    Unreadable {
        /// The folder.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// It cannot be written.
    #[error(transparent)]
    NotWritable(#[from] WriteError),
    /// It belongs to a run with other options.
    #[error(
        "{}: holds {state} run of another kind ({}); choose another folder or remove it",
        shown(path),
        foreign::sentence(difference)
    )]
    OtherRun {
        /// The folder.
        path: PathBuf,
        /// `an unfinished`, `a finished` or `a part of a`.
        state: &'static str,
        /// The difference between that run and the one that was asked for, as a clause.
        difference: String,
    },
    /// It belongs to a run of an earlier version, whose description cannot be compared.
    #[error("{}: holds a run of an earlier version of PHASE, which this one cannot continue; choose a new folder with --out", shown(.0))]
    EarlierRun(PathBuf),
    /// Another run is writing into it right now.
    #[error("{}: is in use by another run; wait for it to finish or choose another folder", shown(.0))]
    Busy(PathBuf),
}

/// Inspects what a folder contains, without changing it. `last_file` is the name of the file a run writes
/// last.
///
/// # Errors
/// [`FolderError::IsFile`], [`FolderError::Foreign`], [`FolderError::EarlierRun`] or
/// [`FolderError::Unreadable`].
pub fn inspect(path: &Path, last_file: &str) -> Result<Contents, FolderError> {
    let entries = match fs::read_dir(path) {
        Ok(entries) => entries,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Contents::Nothing),
        Err(_) if path.is_file() => return Err(FolderError::IsFile(path.to_owned())),
        // A file on the path to the folder makes it impossible to create; the claim reports that.
        Err(error) if error.kind() == io::ErrorKind::NotADirectory => return Ok(Contents::Nothing),
        Err(source) => return Err(FolderError::Unreadable { path: path.to_owned(), source }),
    };
    let mut names: Vec<String> =
        entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.retain(|name| {
        let is_part = atomic::is_part(name) && name.starts_with(&format!(".{MARKER}"));
        name != LOCK && !is_part && !is_incidental(name.as_ref())
    });
    names.sort();
    if names.is_empty() {
        return Ok(Contents::Nothing);
    }
    if names.iter().any(|name| name == last_file) {
        return Ok(Contents::Finished);
    }
    match json::read(&path.join(MARKER)).ok() {
        Some(run) if run["format"] == RUN_FORMAT => Ok(Contents::Unfinished(run)),
        Some(other) if run::is_earlier(&other) => Err(FolderError::EarlierRun(path.to_owned())),
        _ => Err(FolderError::Foreign { path: path.to_owned(), entry: names.swap_remove(0) }),
    }
}

impl Run {
    /// Checks that the run that a folder holds is this one. `state` is `an unfinished`, `a finished` or `a
    /// part of a`.
    ///
    /// # Errors
    /// [`FolderError::EarlierRun`] or [`FolderError::OtherRun`].
    pub fn check(&self, folder: &Path, state: &'static str, held: &Value) -> Result<(), FolderError> {
        if held["format"] != RUN_FORMAT {
            return Err(FolderError::EarlierRun(folder.to_owned()));
        }
        match self.difference(held) {
            None => Ok(()),
            Some(difference) => Err(FolderError::OtherRun { path: folder.to_owned(), state, difference }),
        }
    }
}

/// A lock on a folder: no other program writes into it until this is dropped.
#[derive(Debug)]
pub struct Lock {
    // Held for its lock alone.
    _file: File,
}

impl Lock {
    /// Creates the folder if necessary, and locks it.
    ///
    /// # Errors
    /// [`FolderError::NotWritable`] or [`FolderError::Busy`].
    pub fn take(path: &Path) -> Result<Self, FolderError> {
        let failed = |source| WriteError { path: path.to_owned(), action: "create the folder", source };
        fs::create_dir_all(path).map_err(failed)?;
        Self::take_with(path, OpenOptions::new())
    }

    /// As [`Lock::take`], with a folder and a lock that are their owner's alone if they are created; see
    /// [`private`].
    ///
    /// # Errors
    /// [`FolderError::NotWritable`] or [`FolderError::Busy`].
    pub fn take_private(path: &Path) -> Result<Self, FolderError> {
        let failed = |source| WriteError { path: path.to_owned(), action: "create the folder", source };
        private::create_folder(path).map_err(failed)?;
        Self::take_with(path, private::options())
    }

    fn take_with(path: &Path, mut options: OpenOptions) -> Result<Self, FolderError> {
        let failed = |action, source| WriteError { path: path.to_owned(), action, source };
        let lock = path.join(LOCK);
        // To open a pipe would wait for whoever reads it.
        if fs::symlink_metadata(&lock).is_ok_and(|about| !about.is_file()) {
            return Err(FolderError::Foreign { path: path.to_owned(), entry: LOCK.to_owned() });
        }
        let file = options.create(true).write(true).truncate(false).open(lock);
        let file = file.map_err(|source| failed("write into the folder", source))?;
        match file.try_lock() {
            Ok(()) => Ok(Self { _file: file }),
            Err(TryLockError::WouldBlock) => Err(FolderError::Busy(path.to_owned())),
            Err(TryLockError::Error(source)) => Err(failed("lock the folder", source).into()),
        }
    }
}

/// A folder that only this run writes into, until it is dropped.
///
/// The folder holds the run's description from the beginning, so that the same command goes on with it after
/// an interruption, and another command is refused. [`Folder::finish`] removes what only served the run.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    // Held, not used.
    _lock: Lock,
}

impl Folder {
    /// Creates the folder if necessary, locks it and records which run it belongs to. Only for folders that
    /// [`inspect`] has found usable.
    ///
    /// # Errors
    /// [`FolderError::NotWritable`] or [`FolderError::Busy`].
    pub fn claim(path: &Path, run: &Run) -> Result<Self, FolderError> {
        let lock = Lock::take(path)?;
        atomic::write_json_line(&path.join(MARKER), run)?;
        let folder = Self { path: path.to_owned(), _lock: lock };
        folder.subfolder(CACHE)?;
        Ok(folder)
    }

    /// The folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The folder's directory for files that are needed only until the run ends.
    #[must_use]
    pub fn cache(&self) -> PathBuf {
        self.path.join(CACHE)
    }

    /// Creates a folder in the folder and removes unfinished files of an earlier run from it.
    ///
    /// # Errors
    /// If it cannot be created.
    pub fn subfolder(&self, name: &str) -> Result<PathBuf, WriteError> {
        let path = self.path.join(name);
        fs::create_dir_all(&path).map_err(|source| WriteError {
            path: path.clone(),
            action: "create the folder",
            source,
        })?;
        clear_parts(&path);
        Ok(path)
    }

    /// Removes everything that served the run and is not part of its result.
    ///
    /// # Errors
    /// If something cannot be removed.
    pub fn finish(self) -> Result<(), WriteError> {
        clear_parts(&self.path);
        remove(&self.cache(), |path| fs::remove_dir_all(path))?;
        remove(&self.path.join(MARKER), |path| fs::remove_file(path))?;
        remove(&self.path.join(LOCK), |path| fs::remove_file(path))
    }
}

/// Removes from a finished folder what a run that was stopped at its very end has left there.
///
/// # Errors
/// [`FolderError::NotWritable`] or [`FolderError::Busy`].
pub fn remove_leftovers(path: &Path, run: &Run) -> Result<(), FolderError> {
    if [MARKER, LOCK, CACHE].iter().any(|name| path.join(name).exists()) {
        Folder::claim(path, run)?.finish()?;
    }
    Ok(())
}

fn clear_parts(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        if atomic::is_part(&entry.file_name().to_string_lossy()) {
            // Files that cannot be removed are harmless; the run does not depend on them.
            let _ = fs::remove_file(entry.path());
        }
    }
}

fn remove(path: &Path, how: impl Fn(&Path) -> io::Result<()>) -> Result<(), WriteError> {
    match fault::step().and_then(|()| how(path)) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => {
            Err(WriteError { path: path.to_owned(), action: "remove it", source })
        }
        _ => Ok(()),
    }
}
