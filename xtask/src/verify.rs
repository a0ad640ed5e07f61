//! `verify`: whether a dataset is whole and its files agree.

use crate::{
    cli::Verify,
    console::{remark, tell},
    error::CliError,
};
use phase_dataset::{
    folder::{self, Contents},
    manifest::{MANIFEST_FILE, Manifest},
    verify::verify,
};

/// Runs the command: a sentence for each problem, or one that there is none.
///
/// # Errors
/// [`CliError::NotWhole`] if there is a problem; [`CliError::NotADataset`], [`CliError::Unfinished`] or a
/// [`CliError::File`] if there is no manifest to check against.
pub fn run(arguments: &Verify) -> Result<(), CliError> {
    let folder = &arguments.folder;
    match folder::inspect(folder, MANIFEST_FILE) {
        Ok(Contents::Finished) => {}
        Ok(Contents::Unfinished(_)) => return Err(CliError::Unfinished(folder.clone())),
        _ => return Err(CliError::NotADataset(folder.clone())),
    }
    let manifest = Manifest::read(&folder.join(MANIFEST_FILE))?;
    let problems = verify(folder, &manifest);
    for problem in &problems {
        remark(problem);
    }
    if problems.is_empty() {
        tell(format!("all {} events are whole", manifest.events.len()));
        Ok(())
    } else {
        Err(CliError::NotWhole { folder: folder.clone(), problems: problems.len() })
    }
}
