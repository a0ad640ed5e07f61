//! Folders that are whole or absent: filled under a hidden name, and renamed.

use crate::{WriteError, atomic, fault, folder::FolderError, incidental::is_incidental, private};
use std::{
    fs::{self, File, TryLockError},
    io,
    path::{Path, PathBuf},
};

/// Rights of what is created.
#[derive(Clone, Copy, Debug)]
enum Rights {
    Usual,
    OwnerAlone,
}

impl Rights {
    fn create_folder(self, path: &Path) -> io::Result<()> {
        match self {
            Self::Usual => fs::create_dir_all(path),
            Self::OwnerAlone => private::create_folder(path),
        }
    }
}

/// A folder whose files appear only when all of them are finished.
///
/// They are written into a hidden folder, which [`NewFolder::commit`] gives its name. If this is dropped
/// before, they are removed, and nothing is left under the name; if the program is killed, the hidden folder
/// is left, until somebody makes a folder of this name.
///
/// A folder that is there must be empty. It stays, since other disks may be mounted there and other programs
/// be in it: the hidden folder lies inside, and its files move up at the end. Only then a kill can leave some
/// of them.
#[derive(Debug)]
pub struct NewFolder {
    path: PathBuf,
    part: PathBuf,
    is_there: bool,
    rights: Rights,
    // Held for its lock alone, where folders can be locked.
    _lock: Option<File>,
}

impl NewFolder {
    /// Begins a folder. Folders on the way are created.
    ///
    /// # Errors
    /// If there is something in the folder, another program is filling it, or it cannot be created.
    pub fn create(path: &Path) -> Result<Self, FolderError> {
        Self::create_with(path, Rights::Usual)
    }

    /// As [`NewFolder::create`], with files and folders that are their owner's alone if they are created; see
    /// [`private`].
    ///
    /// # Errors
    /// As [`NewFolder::create`].
    pub fn create_private(path: &Path) -> Result<Self, FolderError> {
        Self::create_with(path, Rights::OwnerAlone)
    }

    fn create_with(path: &Path, rights: Rights) -> Result<Self, FolderError> {
        let failed = |source| error(path, "create the folder", source);
        let is_there = refuse_contents(path)?;
        let mut lock = None;
        let wish = if is_there {
            match locked(path) {
                Ok(found) => lock = found,
                Err(()) => return Err(FolderError::Busy(path.to_owned())),
            }
            // Another program may just have finished.
            refuse_contents(path)?;
            path.join("new")
        } else {
            let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
            parent.map(|parent| rights.create_folder(parent)).transpose().map_err(failed)?;
            path.to_owned()
        };
        remove_abandoned(&wish);
        fault::step().map_err(failed)?;
        loop {
            let part = atomic::part_path(&wish);
            if part.exists() {
                continue;
            }
            rights.create_folder(&part).map_err(failed)?;
            if is_there {
                return Ok(Self { path: path.to_owned(), part, is_there, rights, _lock: lock });
            }
            // Between its creation and its lock somebody can take it for abandoned.
            if let Ok(lock) = locked(&part)
                && part.exists()
            {
                return Ok(Self { path: path.to_owned(), part, is_there, rights, _lock: lock });
            }
        }
    }

    /// The hidden folder, to read what was written.
    #[must_use]
    pub fn part(&self) -> &Path {
        &self.part
    }

    /// Writes a file of this name, which may have folders in it.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write(&self, name: impl AsRef<Path>, bytes: &[u8]) -> Result<(), WriteError> {
        let (name, place) = (name.as_ref(), self.part.join(&name));
        let written = place.parent().map(|folder| self.rights.create_folder(folder)).transpose();
        let written = written.map_err(|source| WriteError {
            path: self.path.clone(),
            action: "create the folder",
            source,
        });
        // The file's own name tells more than the hidden one.
        written
            .and_then(|_| match self.rights {
                Rights::Usual => atomic::write(&place, bytes),
                Rights::OwnerAlone => atomic::write_private(&place, bytes),
            })
            .map_err(|error| WriteError { path: self.path.join(name), ..error })
    }

    /// Gives the folder its name.
    ///
    /// # Errors
    /// If something is in the way or the system refuses; then nothing is left under the name.
    pub fn commit(self) -> Result<(), FolderError> {
        let failed = |source| error(&self.path, "name the folder", source);
        fault::step().map_err(failed)?;
        if self.is_there {
            self.move_up().map_err(failed)?;
        } else {
            // Another program may have been faster.
            refuse_contents(&self.path)?;
            fs::rename(&self.part, &self.path).map_err(failed)?;
        }
        atomic::sync_folder(&self.path);
        // Under its name it is there, whatever comes.
        let _ = fault::step();
        Ok(())
    }

    /// Moves everything from the hidden folder into the one that it is in; all or nothing.
    fn move_up(&self) -> io::Result<()> {
        let entries = fs::read_dir(&self.part)?.collect::<io::Result<Vec<_>>>()?;
        let mut moved = Vec::new();
        for entry in entries {
            let to = self.path.join(entry.file_name());
            let result = fault::step().and_then(|()| fs::rename(entry.path(), &to));
            if let Err(error) = result {
                for (from, to) in moved {
                    // The first error tells more.
                    let _ = fs::rename(to, from);
                }
                return Err(error);
            }
            moved.push((entry.path(), to));
        }
        Ok(())
    }
}

impl Drop for NewFolder {
    fn drop(&mut self) {
        // After a rename there is nothing to remove, and a failure here cannot be reported.
        let _ = fs::remove_dir_all(&self.part);
    }
}

/// Whether there is a folder; refused if there is something in it but what systems leave, and what killed
/// programs left of this one.
fn refuse_contents(path: &Path) -> Result<bool, FolderError> {
    let entries = match fs::read_dir(path) {
        Ok(entries) => entries,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(false),
        Err(_) if path.is_file() => return Err(FolderError::IsFile(path.to_owned())),
        Err(source) => return Err(FolderError::Unreadable { path: path.to_owned(), source }),
    };
    let own = atomic::parts_of(&path.join("new"));
    for entry in entries {
        let entry = entry.map_err(|source| FolderError::Unreadable { path: path.to_owned(), source })?;
        if !is_incidental(&entry.file_name()) && !own.contains(&entry.path()) {
            let entry = entry.file_name().to_string_lossy().into_owned();
            return Err(FolderError::Foreign { path: path.to_owned(), entry });
        }
    }
    Ok(true)
}

/// Removes the hidden folders that killed programs have left of a folder.
fn remove_abandoned(path: &Path) {
    for part in atomic::parts_of(path) {
        // Where there are no locks, nothing is ever taken for abandoned.
        if let Ok(Some(_lock)) = locked(&part) {
            // One that cannot be removed is harmless.
            let _ = fs::remove_dir_all(&part);
        }
    }
}

/// Locks a folder until the file is dropped; `None` where folders cannot be locked.
///
/// # Errors
/// If somebody else has locked it.
fn locked(path: &Path) -> Result<Option<File>, ()> {
    let Ok(file) = File::open(path) else { return Ok(None) };
    match file.try_lock() {
        Ok(()) => Ok(Some(file)),
        Err(TryLockError::WouldBlock) => Err(()),
        Err(TryLockError::Error(_)) => Ok(None),
    }
}

fn error(path: &Path, action: &'static str, source: io::Error) -> FolderError {
    WriteError { path: path.to_owned(), action, source }.into()
}
