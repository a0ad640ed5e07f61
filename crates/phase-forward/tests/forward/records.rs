//! Records of the published simulator, where they are available.

use std::path::{Path, PathBuf};

/// A file of the reference material beside the project, or `None` (with a message) where there is none.
pub(crate) fn path(file: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared").join(file);
    if !path.is_file() {
        println!("skipped: there is no reference material beside the project");
        return None;
    }
    Some(path)
}

/// The text of such a file.
pub(crate) fn text(file: &str) -> Option<String> {
    Some(std::fs::read_to_string(path(file)?).expect("a readable file"))
}
