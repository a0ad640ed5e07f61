//! `check-verify`: how many edits of a dataset `verify` finds, and with which of its options.
//!
//! A small dataset is made, and for each edit a copy of it is changed in a random place. Some edits are
//! accidents; the others are made by somebody who mends what betrays them: the checksums, or every file that
//! describes the events, with PHASE's own code.

mod edit;
mod event_edits;
mod file_edits;
mod folder;
mod kinds;

use crate::error::TortureError;
use clap::{Args, value_parser};
use folder::{EditedCopy, Original};
use kinds::{KINDS, Kind};
use phase_cli::{
    context::Context,
    output::{print_json, print_result},
    parallel::Jobs,
};
use phase_dataset::manifest::Manifest;
use phase_files::FileError;
use phase_model::random::{Purpose, stream};
use phase_runs::{
    error::RunError,
    listener::Silent,
    verify::{self, Checks},
};
use serde_json::{Value, json};
use std::path::Path;

/// Draws of an edit of a kind until one changes something.
const MOST_DRAWS: usize = 100;

/// Options of `check-verify`.
#[derive(Args, Debug)]
pub struct CheckVerify {
    /// Number of edits, of all kinds in turn
    #[arg(long, value_name = "N", default_value_t = 1000,
        value_parser = value_parser!(u32).range(1..=1_000_000))]
    pub edits: u32,
    /// Seed of the edits
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Make only edits of the kinds whose names contain this
    #[arg(long, value_name = "TEXT")]
    pub only: Option<String>,
    /// Print the counts as a single JSON object
    #[arg(long)]
    pub json: bool,
    /// Number of checks at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// The cheapest options of `verify` that find an edit.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Found {
    Files,
    Replay,
    Resimulate,
    Digest,
    Missed,
}

impl Found {
    const ALL: [Self; 5] = [Self::Files, Self::Replay, Self::Resimulate, Self::Digest, Self::Missed];

    const fn name(self) -> &'static str {
        match self {
            Self::Files => "verify",
            Self::Replay => "--replay",
            Self::Resimulate => "--resimulate all",
            Self::Digest => "--digest",
            Self::Missed => "missed",
        }
    }
}

/// Runs the command.
///
/// # Errors
/// If the dataset cannot be made, or a file cannot be copied or changed.
pub fn run(arguments: &CheckVerify, context: &Context) -> Result<(), TortureError> {
    let wanted = |kind: &&Kind| arguments.only.as_ref().is_none_or(|text| kind.name.contains(text.as_str()));
    let kinds: Vec<&Kind> = KINDS.iter().filter(wanted).collect();
    if kinds.is_empty() {
        return Err(RunError::Usage("--only: no kind of edit has such a name".into()).into());
    }
    let original = Original::make()?;
    let count = arguments.edits as usize;
    let progress = context.progress_over(&format!("{count} edits"), count);
    let mut counts = vec![[0; Found::ALL.len()]; kinds.len()];
    for number in 0..count {
        let kind = number % kinds.len();
        let found = one(&original, kinds[kind], number, arguments)?;
        if found == Found::Missed {
            context.note(format!("edit {number} ({}) was missed", kinds[kind].name));
        }
        counts[kind][found as usize] += 1;
        progress.steps(1);
    }
    drop(progress);
    if arguments.json { Ok(print_json(&value(&kinds, &counts))?) } else { print_table(&kinds, &counts) }
}

/// Makes one edit, and looks for it.
fn one(
    original: &Original,
    kind: &Kind,
    number: usize,
    arguments: &CheckVerify,
) -> Result<Found, TortureError> {
    let mut random = stream(arguments.seed, Purpose::Event, number as u64);
    for _ in 0..MOST_DRAWS {
        let mut copy = original.copy()?;
        let made = (kind.make)(&mut copy, &mut random, original)?;
        if made && copy.mend(kind.mends)? && original.differs(&copy)? {
            return look(&copy, original, arguments);
        }
    }
    let sentence = format!("no edit of the kind {:?} changes anything", kind.name);
    Err(RunError::Usage(sentence).into())
}

fn look(copy: &EditedCopy, original: &Original, arguments: &CheckVerify) -> Result<Found, TortureError> {
    let folder = copy.path();
    let with = |checks: Checks| problems(&folder, &checks, arguments);
    if with(Checks::default())? {
        return Ok(Found::Files);
    }
    if with(Checks { replay: true, preset: Some(original.preset()), ..Checks::default() })? {
        return Ok(Found::Replay);
    }
    if with(Checks { resimulate: Some(usize::MAX), ..Checks::default() })? {
        return Ok(Found::Resimulate);
    }
    let digest = Some(original.digest().to_owned());
    Ok(if with(Checks { digest, ..Checks::default() })? { Found::Digest } else { Found::Missed })
}

/// Whether something is found wrong.
fn problems(folder: &Path, checks: &Checks, arguments: &CheckVerify) -> Result<bool, TortureError> {
    let manifest: Result<Manifest, FileError> = verify::manifest(folder);
    match manifest {
        Err(_) => Ok(true),
        Ok(manifest) => {
            let found = verify::problems(folder, &manifest, checks, arguments.jobs.given(), &Silent)?;
            Ok(!found.is_empty())
        }
    }
}

fn sums(counts: &[[usize; Found::ALL.len()]]) -> [usize; Found::ALL.len()] {
    core::array::from_fn(|k| counts.iter().map(|row| row[k]).sum())
}

fn value(kinds: &[&Kind], counts: &[[usize; Found::ALL.len()]]) -> Value {
    let of = |row: &[usize; Found::ALL.len()]| -> Value {
        Found::ALL.iter().zip(row).map(|(found, count)| (found.name().to_owned(), json!(count))).collect()
    };
    let rows = kinds
        .iter()
        .zip(counts)
        .map(|(kind, row)| json!({ "kind": kind.name, "mends": kind.mends.name(), "found_by": of(row) }));
    json!({ "kinds": rows.collect::<Vec<_>>(), "all": of(&sums(counts)) })
}

fn print_table(kinds: &[&Kind], counts: &[[usize; Found::ALL.len()]]) -> Result<(), TortureError> {
    let heads = Found::ALL.map(|found| found.name().to_owned());
    let mut lines = vec![
        format!("| edit | mended | {} |", heads.join(" | ")),
        format!("|---|---{}|", "|---:".repeat(heads.len())),
    ];
    let row = |name: &str, mends: &str, counts: &[usize; Found::ALL.len()]| {
        format!("| {name} | {mends} | {} |", counts.map(|count| count.to_string()).join(" | "))
    };
    lines.extend(kinds.iter().zip(counts).map(|(kind, counts)| row(kind.name, kind.mends.name(), counts)));
    lines.push(row("all", "", &sums(counts)));
    print_result(lines.join("\n"))?;
    Ok(())
}
