//! `verify`: whether a dataset is complete and its files agree, and whether they are what they say they are.

pub mod options;

use crate::{console::print_message, context::Context, error::CliError, output::print_json};
use options::Verify;
use phase_dataset::manifest::MANIFEST_FILE;
use phase_files::{checksum::FileEntry, told};
use phase_runs::{
    shortcuts::{self, audited},
    verify::{self, Checks},
};
use serde_json::json;

/// Runs the command: a sentence for each problem, or one stating that there is none.
///
/// # Errors
/// [`CliError::NotWhole`] if there is a problem; [`CliError::Run`] if there is no manifest to check against.
pub fn run(arguments: &Verify, context: &Context) -> Result<(), CliError> {
    let folder = &arguments.folder;
    let threads = arguments.jobs.given();
    let manifest = verify::open(folder)?;
    let digest = FileEntry::of(folder, MANIFEST_FILE)?.sha256;
    let checks = Checks::from(&arguments.checks);
    let problems = verify::problems(folder, &manifest, &checks, threads, context)?;
    for problem in &problems {
        print_message(problem);
    }
    let events = manifest.events.len();
    let sentences: Vec<String> = problems.iter().map(ToString::to_string).collect();
    let mut value = json!({
        "folder": told(folder), "events": events, "whole": problems.is_empty(), "problems": sentences,
        "manifest_sha256": digest, "replayed": checks.replay,
        "resimulated": checks.resimulate.map_or(0, |count| count.min(events)),
    });
    if problems.is_empty() {
        let audit = audited(folder, threads, context)?;
        let shortcuts = audit.as_ref().map(shortcuts::verdict).unwrap_or_default();
        value["shortcuts"] = audit.as_ref().map(shortcuts::value).into();
        let known = if checks.digest.is_some() { ", as expected" } else { "" };
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
