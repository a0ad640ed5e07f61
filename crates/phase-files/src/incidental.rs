//! Files that systems and tools leave in folders, and that are no part of what a folder holds.

use std::{ffi::OsStr, fs, io, path::Path};

/// Files that macOS, Windows and KDE leave in any folder.
const ANYWHERE: [&str; 5] = [".DS_Store", ".localized", "Thumbs.db", "desktop.ini", ".directory"];
/// Things that Git, DVC, and programs that download datasets leave at the top of a folder.
const AT_THE_TOP: [&str; 7] =
    [".git", ".gitattributes", ".gitignore", ".gitkeep", ".dvc", ".huggingface", ".cache/huggingface"];

/// Whether a name is that of a file that a system leaves in folders, among them macOS's copies of what FAT
/// cannot hold: `._` before the name of another file.
///
/// ```
/// # use phase_files::incidental::is_incidental;
/// assert!(is_incidental(".DS_Store".as_ref()) && is_incidental("._event.json".as_ref()));
/// assert!(!is_incidental("event.json".as_ref()) && !is_incidental(".phase-lock".as_ref()));
/// ```
#[must_use]
pub fn is_incidental(name: &OsStr) -> bool {
    name.as_encoded_bytes().starts_with(b"._") || ANYWHERE.iter().any(|known| name == *known)
}

/// Whether a file or folder among data is one that a system leaves anywhere, or that Git and programs that
/// download datasets leave at the top. `path` is relative to the folder of the data, with `/`.
#[must_use]
pub fn is_incidental_below(path: &str, is_folder: bool) -> bool {
    let name = path.rsplit('/').next().unwrap_or(path);
    AT_THE_TOP.contains(&path) || (!is_folder && is_incidental(name.as_ref()))
}

/// Whether a folder is not there, or holds nothing but files that systems leave.
///
/// # Errors
/// If it cannot be listed.
pub fn is_empty(folder: &Path) -> io::Result<bool> {
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(true),
        Err(error) => return Err(error),
    };
    for entry in entries {
        if !is_incidental(&entry?.file_name()) {
            return Ok(false);
        }
    }
    Ok(true)
}
