//! `verify`: whether a dataset is complete and its files agree.

use crate::{
    console::{self, print_message},
    context::Context,
    error::CliError,
    output::{Output, print_json},
    parallel::{Jobs, make_all},
    shortcuts::{self, audited},
};
use clap::Args;
use phase_dataset::{
    folder::{self, Contents},
    manifest::{MANIFEST_FILE, Manifest},
    verify::{Check, verify_with, work},
};
use serde_json::json;
use std::path::PathBuf;

/// Options of `verify`.
#[derive(Args, Debug)]
pub struct Verify {
    /// Folder of a finished dataset
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// How the result is printed.
    #[command(flatten)]
    pub output: Output,
    /// How many files at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// Runs the command: a sentence for each problem, or one stating that there is none.
///
/// # Errors
/// [`CliError::NotWhole`] if there is a problem; [`CliError::Usage`], [`CliError::Unfinished`] or a
/// [`CliError::File`] if there is no manifest to check against; [`CliError::Threads`].
pub fn run(arguments: &Verify, context: &Context) -> Result<(), CliError> {
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
    // Errors of the Parquet library about a file that was damaged on purpose are returned as a problem; its
    // panics must not be visible.
    let hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let progress = context
        .progress_over(&format!("verifying {}", console::events(manifest.events.len())), work(&manifest));
    let run = |count: usize, check: &Check<'_>| {
        let answers = make_all(&arguments.jobs, count, |k| Ok(Some(check(k))))?;
        // There is always a result: interruptions are not handled here, and nothing is written.
        Ok::<_, CliError>(answers.unwrap_or_default())
    };
    let problems = verify_with(folder, &manifest, &|steps| progress.steps(steps), run);
    drop(progress);
    std::panic::set_hook(hook);
    let problems = problems?;
    for problem in &problems {
        print_message(problem);
    }
    let events = manifest.events.len();
    let sentences: Vec<String> = problems.iter().map(ToString::to_string).collect();
    let mut value =
        json!({ "folder": folder, "events": events, "whole": problems.is_empty(), "problems": sentences });
    if problems.is_empty() {
        let audit = audited(folder, &arguments.jobs, context)?;
        let shortcuts = audit.as_ref().map(shortcuts::verdict).unwrap_or_default();
        value["shortcuts"] = audit.as_ref().map(shortcuts::value).into();
        arguments.output.print(format!("all {events} events are whole{shortcuts}"), &value)
    } else {
        if arguments.output.json {
            print_json(&value)?;
        }
        Err(CliError::NotWhole { folder: folder.clone(), problems: problems.len() })
    }
}
