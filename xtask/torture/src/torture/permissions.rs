//! Permissions to write, taken away and given back. They do not bind an administrator: for it, programs run
//! as another user.

use std::{io, path::Path, process::Command};

/// Whether this system has permissions of this kind.
pub(super) const EXIST: bool = cfg!(unix);

#[cfg(unix)]
mod unix {
    use super::{Command, Path, io};
    use std::{
        fs::{self, Permissions},
        os::unix::{
            fs::{MetadataExt as _, PermissionsExt as _, chown},
            process::CommandExt as _,
        },
    };

    /// The user `nobody`, and its group.
    const NOBODY: u32 = 65_534;

    fn is_administrator() -> io::Result<bool> {
        // New folders belong to who runs this.
        Ok(tempfile::tempdir()?.path().metadata()?.uid() == 0)
    }

    pub(crate) fn bind(command: &mut Command) {
        if is_administrator().unwrap_or(false) {
            command.uid(NOBODY).gid(NOBODY);
        }
    }

    pub(crate) fn own(place: &Path) -> io::Result<()> {
        if !is_administrator()? {
            return Ok(());
        }
        each(place, &mut |path, is_folder| {
            chown(path, Some(NOBODY), Some(NOBODY))?;
            if is_folder { fs::set_permissions(path, Permissions::from_mode(0o755)) } else { Ok(()) }
        })
    }

    pub(crate) fn show(path: &Path) -> io::Result<()> {
        each(path, &mut |path, is_folder| {
            let mode = if is_folder { 0o755 } else { path.metadata()?.permissions().mode() | 0o444 };
            fs::set_permissions(path, Permissions::from_mode(mode))
        })
    }

    pub(crate) fn set(place: &Path, mode: u32) -> io::Result<()> {
        each(place, &mut |path, is_folder| {
            if is_folder { fs::set_permissions(path, Permissions::from_mode(mode)) } else { Ok(()) }
        })
    }

    /// Does something to a folder, and then to all that is in it. What is gone by then needs nothing.
    fn each(path: &Path, what: &mut impl FnMut(&Path, bool) -> io::Result<()>) -> io::Result<()> {
        let there = |result: io::Result<()>| match result {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
            result => result,
        };
        let is_folder = path.is_dir();
        there(what(path, is_folder))?;
        let entries = match fs::read_dir(path) {
            Err(_) if !is_folder || !path.exists() => return Ok(()),
            entries => entries?,
        };
        for entry in entries {
            each(&entry?.path(), what)?;
        }
        Ok(())
    }
}

/// Has a command run as a user whom permissions bind.
pub(super) fn bind(command: &mut Command) {
    #[cfg(unix)]
    unix::bind(command);
    #[cfg(not(unix))]
    let _ = command;
}

/// Gives a folder and all in it to that user.
pub(super) fn own(place: &Path) -> io::Result<()> {
    #[cfg(unix)]
    return unix::own(place);
    #[cfg(not(unix))]
    return unknown(place);
}

/// Lets that user read a folder and all in it.
pub(super) fn show(path: &Path) -> io::Result<()> {
    #[cfg(unix)]
    return unix::show(path);
    #[cfg(not(unix))]
    return unknown(path);
}

/// Takes the permission to write away from a folder and those in it: in them nothing can be created, renamed
/// or removed.
pub(super) fn revoke(place: &Path) -> io::Result<()> {
    #[cfg(unix)]
    return unix::set(place, 0o555);
    #[cfg(not(unix))]
    return unknown(place);
}

/// Gives it back.
pub(super) fn give_back(place: &Path) -> io::Result<()> {
    #[cfg(unix)]
    return unix::set(place, 0o755);
    #[cfg(not(unix))]
    return unknown(place);
}

#[cfg(not(unix))]
fn unknown(_: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}
