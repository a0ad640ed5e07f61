//! `verify`: whether a dataset is complete and its files agree, and whether they are what they say they are.

pub mod derived;
pub mod options;
mod origin;
mod replay;

use crate::{
    console::{self, print_message},
    context::Context,
    error::CliError,
    output::print_json,
    parallel::{Jobs, make_all},
    shortcuts::{self, audited},
};
use options::{Checks, Verify};
use phase_dataset::{
    manifest::{MANIFEST_FILE, Manifest},
    verify::{Check, verify_with, work},
};
use phase_files::{
    FileError, Problem,
    checksum::FileEntry,
    folder::{self, Contents, FolderError},
};
use phase_model::random::{self, Purpose};
use rand::seq::SliceRandom;
use serde_json::json;
use std::{fs, path::Path};

/// Runs the command: a sentence for each problem, or one stating that there is none.
///
/// # Errors
/// [`CliError::NotWhole`] if there is a problem; [`CliError::Usage`], [`CliError::Unfinished`] or a
/// [`CliError::File`] if there is no manifest to check against; [`CliError::Threads`].
pub fn run(arguments: &Verify, context: &Context) -> Result<(), CliError> {
    let folder = &arguments.folder;
    match folder::inspect(folder, MANIFEST_FILE) {
        Ok(Contents::Finished) => {}
        Ok(Contents::Unfinished(_)) | Err(FolderError::EarlierRun(_)) => {
            return Err(CliError::Unfinished(folder.clone()));
        }
        _ => {
            let rule = "holds no manifest.json; give the folder of a finished dataset";
            return Err(CliError::Usage(format!("{}: {rule}", folder.display())));
        }
    }
    let manifest = manifest(folder)?;
    let digest = FileEntry::of(folder, MANIFEST_FILE)?.sha256;
    let problems = problems(folder, &manifest, &arguments.checks, &arguments.jobs, context)?;
    for problem in &problems {
        print_message(problem);
    }
    let events = manifest.events.len();
    let sentences: Vec<String> = problems.iter().map(ToString::to_string).collect();
    let mut value = json!({
        "folder": folder, "events": events, "whole": problems.is_empty(), "problems": sentences,
        "manifest_sha256": digest, "replayed": arguments.checks.replay,
        "resimulated": arguments.checks.resimulate.map_or(0, |count| count.min(events)),
    });
    if problems.is_empty() {
        let audit = audited(folder, &arguments.jobs, context)?;
        let shortcuts = audit.as_ref().map(shortcuts::verdict).unwrap_or_default();
        value["shortcuts"] = audit.as_ref().map(shortcuts::value).into();
        let known = if arguments.checks.digest.is_some() { ", as expected" } else { "" };
        let text =
            format!("all {events} events are whole{shortcuts}\nSHA-256 of {MANIFEST_FILE}: {digest}{known}");
        arguments.output.print(text, &value)
    } else {
        if arguments.output.json {
            print_json(&value)?;
        }
        Err(CliError::NotWhole { folder: folder.clone(), problems: problems.len() })
    }
}

/// Reads the manifest of a dataset, which has to be a file: nothing is waited for.
///
/// # Errors
/// If it is none, or cannot be used.
pub fn manifest(folder: &Path) -> Result<Manifest, FileError> {
    let file = folder.join(MANIFEST_FILE);
    let problem = match fs::symlink_metadata(&file) {
        Ok(about) if about.is_file() => return Manifest::read(&file),
        Ok(about) if about.is_symlink() => Problem::Link,
        Ok(_) => Problem::NoFile,
        Err(error) => Problem::Unreadable(error),
    };
    Err(FileError { file, problem })
}

/// Everything that is wrong with a dataset. Deeper checks are made of what no cheaper one has found wrong.
///
/// # Errors
/// [`CliError::Threads`], [`CliError::Interrupted`], or if nothing can be written into the system's folder for temporary files.
pub fn problems(
    folder: &Path,
    manifest: &Manifest,
    checks: &Checks,
    jobs: &Jobs,
    context: &Context,
) -> Result<Vec<FileError>, CliError> {
    let progress = context
        .progress_over(&format!("verifying {}", console::events(manifest.events.len())), work(manifest));
    let run = |count: usize, check: &Check<'_>| {
        let answers = make_all(jobs, count, |k| Ok(Some(check(k))))?;
        // There is always a result: interruptions are not handled here, and nothing is written.
        Ok::<_, CliError>(answers.unwrap_or_default())
    };
    let mut problems = verify_with(folder, manifest, &|steps| progress.steps(steps), run)?;
    drop(progress);
    let digest = FileEntry::of(folder, MANIFEST_FILE)?.sha256;
    if checks.digest.as_ref().is_some_and(|expected| *expected != digest) {
        let file = folder.join(MANIFEST_FILE);
        problems.push(FileError { file, problem: Problem::Differs("the digest that was given".into()) });
    }
    if problems.is_empty() && checks.replay {
        problems = replay::problems(folder, manifest, checks, jobs, context)?;
    }
    if let (true, Some(count)) = (problems.is_empty(), checks.resimulate) {
        let mut events: Vec<usize> = (0..manifest.events.len()).collect();
        events.shuffle(&mut random::stream(checks.resimulate_seed, Purpose::Event, 0));
        events.truncate(count);
        events.sort_unstable();
        problems = replay::simulated_again(folder, manifest, &events, jobs, context)?;
    }
    Ok(problems)
}
