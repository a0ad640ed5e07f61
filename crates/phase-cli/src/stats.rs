//! `stats`: the paper's figures compared with those of a dataset or of other events, and plots of them.

use crate::{context::Context, error::CliError, output::Output, parallel::Jobs};
use clap::Args;
use phase_audit::{Audit, Target};
use phase_dataset::{
    acceptance::Acceptance,
    labels::goal_counts,
    manifest::{MANIFEST_FILE, Manifest},
};
use phase_document::plot::bars;
use phase_files::{WriteError, atomic};
use phase_model::{Scene, arena::STEP_VIDEO_SECONDS};
use phase_report::{
    acceptance,
    statistics::{self, Statistics, StatisticsRow},
};
use phase_runs::{
    shortcuts::{self, audited},
    source::EventInput,
};
use serde_json::{Value, json};
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
};

/// Options of `stats`.
#[derive(Args, Debug)]
pub struct Stats {
    /// A file in the format phase-events/1, or the folder of a dataset or of simulations
    #[arg(value_name = "FILE|DIR")]
    pub events: PathBuf,
    /// Also write the figures and plots (SVG) into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
    /// Number of files at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// Width of the bars in the plot of lengths (s).
const LENGTH_STEP: usize = 1;

/// File name, title, unit, and the bars.
type Plot = (&'static str, &'static str, &'static str, Vec<(String, f64)>);

/// Runs the command.
///
/// # Errors
/// If the events cannot be used or the plots cannot be written.
pub fn run(arguments: &Stats, context: &Context) -> Result<(), CliError> {
    let (statistics, selection) = statistics(&arguments.events, context)?;
    let audit = audited(&arguments.events, arguments.jobs.given(), context)?;
    let text = report(&statistics, &selection, audit.as_ref());
    if let Some(out) = &arguments.out {
        write(out, &text, &statistics, &selection, audit.as_ref()).map_err(CliError::Output)?;
        context.note(format!("figures and plots in {}", out.display()));
    }
    arguments.output.print(text, &value(&statistics, &selection, audit.as_ref()))
}

/// The figures of a dataset, with its manifest's data on the selection; or those of other events, which are
/// in no split.
fn statistics(path: &Path, context: &Context) -> Result<(Statistics, Vec<Acceptance>), CliError> {
    let manifest = path.join(MANIFEST_FILE);
    if manifest.is_file() {
        let manifest = Manifest::read(&manifest)?;
        return Ok((Statistics::of(&manifest), manifest.selection));
    }
    let source = EventInput::open(path, &[], context)?;
    let mut agents = Vec::new();
    let mut layouts = BTreeSet::new();
    let mut lengths = BTreeMap::new();
    let mut relations = BTreeMap::new();
    let mut kinds = BTreeMap::new();
    for index in 0..source.len() {
        let recording = source.load(index)?;
        let Scene { layout, kind, agents: specs, .. } = &recording.scene;
        agents.extend(specs.each_ref().map(|agent| (agent.goal, agent.attitude.alpha())));
        layouts.insert((layout.base(), layout.flip()));
        *lengths.entry(recording.trajectory.steps()).or_default() += 1;
        *relations.entry(recording.relation).or_default() += 1;
        *kinds.entry(*kind).or_default() += 1;
    }
    let events = source.len();
    let goals = goal_counts(agents);
    let layouts = layouts.len();
    Ok((Statistics { events, lengths, goals, relations, kinds, layouts, parts: None }, Vec::new()))
}

/// The figures for programs.
fn value(statistics: &Statistics, selection: &[Acceptance], audit: Option<&Audit>) -> Value {
    let Statistics { events, lengths, goals, relations, kinds, layouts, .. } = statistics;
    let figure =
        |figure: &StatisticsRow| json!({ "figure": figure.what, "paper": figure.paper, "here": figure.ours });
    let figures: Vec<Value> = statistics.figures().iter().map(figure).collect();
    let kinds: BTreeMap<&str, usize> = kinds.iter().map(|(kind, &count)| (kind.name(), count)).collect();
    json!({
        "events": events, "figures": figures, "lengths": lengths, "goals": goals, "relations": relations,
        "kinds": kinds, "layouts": layouts, "selection": selection, "shortcuts": audit.map(shortcuts::value),
    })
}

fn report(statistics: &Statistics, selection: &[Acceptance], audit: Option<&Audit>) -> String {
    let mut text = statistics::table(&statistics.figures());
    text += &list("goal", "agents", statistics.goals.iter().map(|(goal, &count)| (goal.clone(), count)));
    text +=
        &list("kind", "events", statistics.kinds.iter().map(|(kind, &count)| (kind.name().into(), count)));
    if !selection.is_empty() {
        text += &format!("\n{}", acceptance::table(selection));
    }
    text += &shortcuts::section(audit, statistics.events);
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
    audit: Option<&Audit>,
) -> Result<(), WriteError> {
    let failed = |source| WriteError { path: out.to_owned(), action: "create the folder", source };
    fs::create_dir_all(out).map_err(failed)?;
    atomic::write(&out.join("stats.md"), text.as_bytes())?;
    let mut lengths: BTreeMap<usize, usize> = BTreeMap::new();
    for (steps, count) in &statistics.lengths {
        *lengths.entry((*steps as f64 * STEP_VIDEO_SECONDS) as usize / LENGTH_STEP).or_default() += count;
    }
    let seconds = |at: usize| format!("{} to {} s", at * LENGTH_STEP, (at + 1) * LENGTH_STEP);
    let number = |count: usize| count as f64;
    let told = |target: Target| {
        let majority = audit.map(|audit| ("nothing".into(), 100.0 * audit.majorities[target as usize]));
        let rows = audit.into_iter().flat_map(|audit| &audit.rows);
        let rows = rows.map(|row| (row.feature.name().into(), 100.0 * row.accuracies[target as usize]));
        majority.into_iter().chain(rows).collect::<Vec<(String, f64)>>()
    };
    let plots: [Plot; 7] = [
        ("shortcuts-relation.svg", "Relation told from", " %", told(Target::Relation)),
        ("shortcuts-kind.svg", "Kind told from", " %", told(Target::Kind)),
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
            statistics.relations.iter().map(|(&it, &n)| (it.name().into(), number(n))).collect(),
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
