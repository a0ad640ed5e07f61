//! `stats`: the paper's figures beside a dataset's own, and plots of them.

use crate::{console::tell, error::CliError};
use clap::Args;
use phase_dataset::{
    WriteError,
    acceptance::Acceptance,
    atomic,
    manifest::{MANIFEST_FILE, Manifest},
    words,
};
use phase_report::{
    acceptance,
    plot::bars,
    statistics::{self, Statistics},
};
use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

/// Options of `stats`.
#[derive(Args, Debug)]
pub struct Stats {
    /// The folder of a dataset
    #[arg(value_name = "DIR")]
    pub dataset: PathBuf,
    /// Also write the figures and plots (SVG) into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// Width of the bars in the plot of lengths (s).
const LENGTH_STEP: usize = 1;
/// Steps of a second of video.
const STEPS_PER_SECOND: usize = 4;

/// File name, title, unit, and the bars.
type Plot = (&'static str, &'static str, &'static str, Vec<(String, f64)>);

/// Runs the command.
///
/// # Errors
/// If the manifest cannot be used or the plots cannot be written.
pub fn run(arguments: &Stats) -> Result<(), CliError> {
    let manifest = Manifest::read(&arguments.dataset.join(MANIFEST_FILE))?;
    let statistics = Statistics::of(&manifest);
    let text = report(&statistics, &manifest.selection);
    tell(text.trim_end());
    match &arguments.out {
        Some(out) => write(out, &text, &statistics, &manifest.selection).map_err(CliError::Output),
        None => Ok(()),
    }
}

fn report(statistics: &Statistics, selection: &[Acceptance]) -> String {
    let mut text = statistics::table(&statistics.figures());
    text += &list("goal", "agents", statistics.goals.iter().map(|(goal, &count)| (goal.clone(), count)));
    text +=
        &list("kind", "events", statistics.kinds.iter().map(|(kind, &count)| (kind.name().into(), count)));
    if !selection.is_empty() {
        text += &format!("\n{}", acceptance::table(selection));
    }
    text
}

fn list(what: &str, counted: &str, rows: impl Iterator<Item = (String, usize)>) -> String {
    let rows = rows.map(|(name, count)| format!("| {name} | {count} |\n")).collect::<String>();
    format!("\n| {what} | {counted} |\n|---|---|\n{rows}")
}

fn write(
    out: &Path,
    text: &str,
    statistics: &Statistics,
    selection: &[Acceptance],
) -> Result<(), WriteError> {
    let failed = |source| WriteError { path: out.to_owned(), action: "create the folder", source };
    fs::create_dir_all(out).map_err(failed)?;
    atomic::write(&out.join("stats.md"), text.as_bytes())?;
    let mut lengths: BTreeMap<usize, usize> = BTreeMap::new();
    for (steps, count) in &statistics.lengths {
        *lengths.entry(steps / (STEPS_PER_SECOND * LENGTH_STEP)).or_default() += count;
    }
    let seconds = |at: usize| format!("{} to {} s", at * LENGTH_STEP, (at + 1) * LENGTH_STEP);
    let number = |count: usize| count as f64;
    let plots: [Plot; 5] = [
        (
            "lengths.svg",
            "Events by length",
            "",
            lengths.iter().map(|(&at, &n)| (seconds(at), number(n))).collect(),
        ),
        (
            "goals.svg",
            "Agents by goal",
            "",
            statistics.goals.iter().map(|(goal, &n)| (goal.clone(), number(n))).collect(),
        ),
        (
            "kinds.svg",
            "Events by kind",
            "",
            statistics.kinds.iter().map(|(kind, &n)| (kind.name().into(), number(n))).collect(),
        ),
        (
            "relations.svg",
            "Events by relation",
            "",
            statistics.relations.iter().map(|(&it, &n)| (words::relation(it).into(), number(n))).collect(),
        ),
        (
            "acceptance.svg",
            "Scenes accepted, by variant",
            " %",
            selection.iter().map(|row| (row.variant.name().into(), rate(row))).collect(),
        ),
    ];
    for (name, title, unit, rows) in plots.iter().filter(|(_, _, _, rows)| !rows.is_empty()) {
        atomic::write(&out.join(name), bars(title, unit, rows).as_bytes())?;
    }
    Ok(())
}

fn rate(row: &Acceptance) -> f64 {
    100.0 * row.events as f64 / row.attempts.max(1) as f64
}
