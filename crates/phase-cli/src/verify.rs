//! `verify`: whether a dataset is whole and its files agree.

use crate::{
    console::{remark, tell},
    error::CliError,
    parallel::{Jobs, make_all},
    progress::Progress,
};
use clap::Args;
use phase_dataset::{
    folder::{self, Contents},
    manifest::{MANIFEST_FILE, Manifest},
    verify::{Check, verify_with, work},
};
use std::path::PathBuf;

/// Options of `verify`.
#[derive(Args, Debug)]
pub struct Verify {
    /// Folder of a finished dataset
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// How many files at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// Runs the command: a sentence for each problem, or one that there is none.
///
/// # Errors
/// [`CliError::NotWhole`] if there is a problem; [`CliError::Usage`], [`CliError::Unfinished`] or a
/// [`CliError::File`] if there is no manifest to check against; [`CliError::Threads`].
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
    let progress = Progress::over(work(&manifest), manifest.events.len());
    let run = |count: usize, check: &Check<'_>| {
        let answers = make_all(&arguments.jobs, count, |k| Ok(Some(check(k))))?;
        // There is always an answer: only who listens for interruptions stops early, and nothing is written here.
        Ok::<_, CliError>(answers.unwrap_or_default())
    };
    let problems = verify_with(folder, &manifest, &|steps| progress.steps(steps), run);
    drop(progress);
    std::panic::set_hook(hook);
    let problems = problems?;
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
