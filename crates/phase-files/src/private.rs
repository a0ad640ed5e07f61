//! Files and folders that only their owner may read: what people said and did.
//!
//! On systems without modes they have the rights of the folder they are in.

use std::{
    fs::{self, DirBuilder, OpenOptions},
    io,
    path::Path,
};

/// Rights of a folder: its owner's alone.
#[cfg(unix)]
const FOLDER: u32 = 0o700;
/// Rights of a file: its owner's alone.
#[cfg(unix)]
const FILE: u32 = 0o600;

/// Creates a folder, and those on the way that are missing, for their owner alone. One that exists is left as
/// it is.
///
/// # Errors
/// If it cannot be created.
pub fn create_folder(path: &Path) -> io::Result<()> {
    let mut builder = DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    {
        use std::os::unix::fs::DirBuilderExt as _;
        builder.mode(FOLDER);
    }
    builder.create(path)
}

/// Creates a folder as [`create_folder`] does; one that exists becomes its owner's alone, with the files in
/// it.
///
/// # Errors
/// If it cannot be created, read or given these rights.
pub fn take_folder(path: &Path) -> io::Result<()> {
    create_folder(path)?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        fs::set_permissions(path, fs::Permissions::from_mode(FOLDER))?;
        for entry in fs::read_dir(path)? {
            let entry = entry?;
            // Not of what a link leads to.
            if entry.file_type()?.is_file() && entry.metadata()?.permissions().mode() & 0o77 != 0 {
                fs::set_permissions(entry.path(), fs::Permissions::from_mode(FILE))?;
            }
        }
    }
    Ok(())
}

/// Options to open a file with, which is its owner's alone if it is created.
#[must_use]
pub fn options() -> OpenOptions {
    let mut options = OpenOptions::new();
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt as _;
        options.mode(FILE);
    }
    options
}
