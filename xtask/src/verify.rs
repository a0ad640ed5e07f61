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
/// [`CliError::NotWhole`] if there is a problem; [`CliError::Usage`], [`CliError::Unfinished`] or a
/// [`CliError::File`] if there is no manifest to check against.
pub fn run(arguments: &Verify) -> Result<(), CliError> {
    let folder = &arguments.folder;
    match folder::inspect(folder, MANIFEST_FILE) {
        Ok(Contents::Finished) => {}
        Ok(Contents::Unfinished(_)) => return Err(CliError::Unfinished(folder.clone())),
        _ => {
            let rule = "holds no manifest.json; give the folder of a finished dataset";
            return Err(CliError::Usage(format!("{}: {rule}", folder.display())));
        }
    }
    let manifest = Manifest::read(&folder.join(MANIFEST_FILE))?;
    // What the Parquet library has to say about a file that was damaged on purpose comes back as a problem; its
    // panics are not to be seen.
    let hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let problems = verify(folder, &manifest);
    std::panic::set_hook(hook);
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
