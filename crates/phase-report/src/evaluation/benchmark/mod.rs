//! The report of the benchmark: the paper's two tables and its ablation, with published beside measured
//! figures, and the generalisation of methods.

mod figures;
mod growth;
mod mistakes;
mod overview;
mod page;
mod people;
mod tables;
mod training;

pub use figures::{figures, to_lines};
pub use overview::overview;
pub use page::{Page, page};

use super::BESIDE;
use phase_document::{
    document::{Block, Document},
    plot::bars,
};
use phase_eval::{
    benchmark::{Benchmark, Familiarity, Origin, Row},
    goals::RecognitionSummary,
};

/// The benchmark's whole report.
#[must_use]
pub fn benchmark(benchmark: &Benchmark) -> Document {
    let mut blocks =
        vec![Block::Text(introduction(benchmark)), Block::Heading("Table 1: goals and relations".into())];
    blocks.push(tables::goals(benchmark));
    blocks.push(Block::Text(
        "A goal counts as right if kind, entity, landmark and sign all match, over both agents of each event.".into(),
    ));
    blocks.push(Block::Text(BESIDE.into()));
    blocks.extend(chart(
        benchmark,
        "goals.svg",
        "Goals right (most likely one), %",
        &benchmark.goals,
        |summary| 100.0 * summary.all.top1.value,
    ));
    blocks.extend(chart(benchmark, "relations.svg", "Relations right, %", &benchmark.goals, |summary| {
        100.0 * summary.all.relation.value
    }));
    blocks.extend(people::blocks(benchmark));
    blocks.push(Block::Heading("Table 2: trajectories".into()));
    blocks.push(tables::trajectories(benchmark));
    blocks.push(Block::Text(
        "Distances between predicted and true positions of the agents in u, 20 steps after the first 20. Independent \
         events are those with a neutral relation, social the others."
            .into(),
    ));
    blocks.extend(chart(
        benchmark,
        "ade.svg",
        "ADE over all events, u",
        &benchmark.trajectories,
        |summary| summary.all.ade.value,
    ));
    blocks.push(Block::Heading("Ablation of SIMPLE".into()));
    blocks.push(tables::ablation(benchmark));
    blocks.extend(mistakes::blocks(benchmark));
    blocks.push(Block::Heading("What was seen in training and what was not".into()));
    blocks.push(Block::Text(
        "Layouts and types of interaction of the test events that the training and validation events have too, and \
         others. Of methods that learn nothing the difference says how hard these events are."
            .into(),
    ));
    for pair in Familiarity::PAIRS {
        blocks.extend(tables::goal_parts(benchmark, pair));
        blocks.extend(tables::trajectory_parts(benchmark, pair));
    }
    if let Some(table) = tables::sets(benchmark) {
        blocks.push(Block::Heading("Sets that differ in one social variable".into()));
        blocks.push(table);
    }
    blocks.extend(training::blocks(benchmark));
    blocks.extend(growth::blocks(benchmark));
    Document { title: "The PHASE benchmark".into(), blocks }
}

fn introduction(benchmark: &Benchmark) -> String {
    let sets = benchmark.sets.iter().map(|set| format!("{} ({})", set.name, set.events));
    format!(
        "{}, seed {}. Measured on {}. CPU time is that of one thread.",
        benchmark.generator,
        benchmark.seed,
        sets.collect::<Vec<_>>().join(" and ")
    )
}

/// Bars of this project's methods on the first set, for goals and relations.
fn charts(benchmark: &Benchmark) -> Vec<Block> {
    let Some(set) = benchmark.sets.first() else { return Vec::new() };
    let ours = benchmark.goals.iter().filter(|row| row.set == 0 && row.origin == Origin::Ours);
    let chart = |file, what: &str, of: fn(&RecognitionSummary) -> f64| {
        let bars_of = |row: &Row<RecognitionSummary>| (row.method.clone(), 100.0 * of(&row.summary));
        let mut rows: Vec<(String, f64)> = ours.clone().map(bars_of).collect();
        rows.sort_by(|one, other| other.1.total_cmp(&one.1));
        let title = format!("{what} of {} events, %", set.label);
        (!rows.is_empty()).then(|| Block::Plot { file, svg: bars(&title, " %", &rows), title })
    };
    let goals = chart("results-goals.svg", "Right goals", |summary| summary.all.top1.value);
    let relations = chart("results-relations.svg", "Right relations", |summary| summary.all.relation.value);
    goals.into_iter().chain(relations).collect()
}

/// Bars of the methods in the tables, on all sets; none without methods.
fn chart<S>(
    benchmark: &Benchmark,
    file: &'static str,
    title: &str,
    rows: &[Row<S>],
    of: fn(&S) -> f64,
) -> Option<Block> {
    let shown = rows.iter().filter(|row| row.origin != Origin::Trained);
    let name = |row: &Row<S>| match benchmark.sets.len() {
        1 => row.method.clone(),
        _ => format!("{}, {}", row.method, label(benchmark, row.set)),
    };
    let bar = |row: &Row<S>| (name(row), of(&row.summary));
    let rows: Vec<(String, f64)> = shown.map(bar).collect();
    let unit = if title.ends_with('%') { " %" } else { " u" };
    (!rows.is_empty()).then(|| Block::Plot { file, title: title.into(), svg: bars(title, unit, &rows) })
}

/// Name of a set in a table.
fn label(benchmark: &Benchmark, set: usize) -> &str {
    benchmark.sets.get(set).map_or("?", |set| set.label.as_str())
}
