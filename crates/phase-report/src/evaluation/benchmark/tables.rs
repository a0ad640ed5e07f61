//! The tables of the benchmark.

use super::{
    super::{length, share},
    label,
};
use crate::published;
use phase_document::document::{Block, head};
use phase_eval::{
    Estimate,
    benchmark::{Benchmark, Familiarity, Origin, Row, Training},
    goals, trajectories,
};

/// PHASE's methods and their names in the paper, in the paper's order; `simple` is the full method in each
/// table.
const TABLE_1: [(&str, &str); 4] =
    [("", "humans"), ("simple", "SIMPLE"), ("two-level-lstm", "2-Level LSTM"), ("arg", "ARG")];
const TABLE_2: [(&str, &str); 3] = [("simple", "SIMPLE"), ("social-lstm", "Social-LSTM"), ("stgat", "STGAT")];
const ABLATION: [(&str, &str); 5] = [
    ("simple", "SIMPLE"),
    ("simple-points", ""),
    ("simple-local", ""),
    ("simple-global", "SIMPLE (global)"),
    ("simple-initial", "SIMPLE (initial)"),
];
pub(super) const NOTHING: &str = "–";

/// Table 1: every method that is not an ablation, below the published row of its name.
pub(super) fn goals(benchmark: &Benchmark) -> Block {
    let in_ablation = |method: &str| ABLATION.iter().any(|(name, _)| *name == method);
    let in_table = |method: &str| TABLE_1.iter().any(|(name, _)| *name == method);
    let rows = TABLE_1.iter().flat_map(|names| goal_rows(benchmark, names));
    let others = others(&benchmark.goals, |method| in_table(method) || in_ablation(method));
    goal_table(rows.chain(others.into_iter().map(|row| goal_row(benchmark, row))).collect())
}

/// The ablation: SIMPLE with one or two components removed.
pub(super) fn ablation(benchmark: &Benchmark) -> Block {
    goal_table(ABLATION.iter().flat_map(|names| goal_rows(benchmark, names)).collect())
}

fn goal_table(rows: Vec<Vec<String>>) -> Block {
    let columns = [
        "method",
        "events",
        "goal top-1",
        "top-2",
        "top-3",
        "relation",
        "relation as people saw it",
        "CPU s an event",
        "training",
    ];
    Block::Table { head: head(&columns), rows }
}

/// The published row and the measured one.
fn goal_rows(benchmark: &Benchmark, (method, published): &(&str, &str)) -> Vec<Vec<String>> {
    let theirs = published::GOALS.iter().filter(|row| row.method == *published).map(|row| {
        let goals = row.goal.map(|accuracy| format!("{accuracy:.3}"));
        let rest = [format!("{:.2}", row.relation), NOTHING.into(), NOTHING.into(), NOTHING.into()];
        [row.method.to_owned(), row.source.to_owned()].into_iter().chain(goals).chain(rest).collect()
    });
    let ours = benchmark.goals.iter().filter(|row| row.origin == Origin::Ours && row.method == *method);
    theirs.chain(ours.map(|row| goal_row(benchmark, row))).collect()
}

fn goal_row(benchmark: &Benchmark, row: &Row<goals::RecognitionSummary>) -> Vec<String> {
    let scores = &row.summary.all;
    vec![
        name(row),
        events(benchmark, row.set, scores.n),
        share(&scores.top1),
        share(&scores.top2),
        share(&scores.top3),
        share(&scores.relation),
        scores.relation_human.as_ref().map_or_else(|| NOTHING.into(), share),
        seconds(row.summary.cpu_seconds_per_event),
        cost(benchmark, row.training),
    ]
}

/// Table 2.
pub(super) fn trajectories(benchmark: &Benchmark) -> Block {
    let in_table = |method: &str| TABLE_2.iter().any(|(name, _)| *name == method);
    let of_name = |names: &(&str, &str)| -> Vec<Vec<String>> {
        let theirs = published::TRAJECTORIES.iter().filter(|row| row.method == names.1).map(|row| {
            let errors = row.ade.into_iter().chain(row.fde).map(|error| format!("{error:.2}"));
            let rest = [NOTHING.to_owned(), NOTHING.to_owned()];
            [row.method.to_owned(), row.source.to_owned()].into_iter().chain(errors).chain(rest).collect()
        });
        let ours = benchmark.trajectories.iter();
        let ours = ours.filter(|row| row.origin == Origin::Ours && row.method == names.0);
        theirs.chain(ours.map(|row| trajectory_row(benchmark, row))).collect()
    };
    let others = others(&benchmark.trajectories, in_table);
    let others = others.into_iter().map(|row| trajectory_row(benchmark, row));
    let columns = [
        "method",
        "events",
        "ADE independent",
        "social",
        "all",
        "FDE independent",
        "social",
        "all",
        "CPU s an event",
        "training",
    ];
    Block::Table { head: head(&columns), rows: TABLE_2.iter().flat_map(of_name).chain(others).collect() }
}

fn trajectory_row(benchmark: &Benchmark, row: &Row<trajectories::ForecastSummary>) -> Vec<String> {
    let summary = &row.summary;
    let parts = [summary.independent.as_ref(), summary.social.as_ref(), Some(&summary.all)];
    let cells = |of: fn(&trajectories::ForecastScores) -> &Estimate| {
        parts.map(|part| part.map_or_else(|| NOTHING.into(), |scores| length(of(scores))))
    };
    let ade = cells(|scores| &scores.ade);
    let fde = cells(|scores| &scores.fde);
    let rest = [seconds(summary.cpu_seconds_per_event), cost(benchmark, row.training)];
    [name(row), events(benchmark, row.set, summary.all.n)]
        .into_iter()
        .chain(ade)
        .chain(fde)
        .chain(rest)
        .collect()
}

/// Goals and relations on events similar and dissimilar to the training data.
pub(super) fn goal_parts(benchmark: &Benchmark, pair: [Familiarity; 2]) -> Option<Block> {
    part_table(&benchmark.goals, pair, ["goal top-1", "relation"], |summary| {
        (summary.all.n, [share(&summary.all.top1), share(&summary.all.relation)])
    })
}

/// Trajectories of events similar and dissimilar to the training data.
pub(super) fn trajectory_parts(benchmark: &Benchmark, pair: [Familiarity; 2]) -> Option<Block> {
    part_table(&benchmark.trajectories, pair, ["ADE", "FDE"], |summary| {
        (summary.all.n, [length(&summary.all.ade), length(&summary.all.fde)])
    })
}

/// Sets whose events differ in one social variable: the share of them of which all events are right.
pub(super) fn sets(benchmark: &Benchmark) -> Option<Block> {
    let line = |row: &Row<goals::RecognitionSummary>| {
        let sets = row.summary.sets.as_ref()?;
        let all = &row.summary.all;
        let scores = [&sets.relation, &sets.goals, &sets.all, &all.top1, &all.relation].map(share);
        Some([name(row), format!("{} ({} events)", sets.n, all.n)].into_iter().chain(scores).collect())
    };
    let rows = benchmark.goals.iter().filter(|row| row.origin != Origin::Trained);
    let rows: Vec<Vec<String>> = rows.filter_map(line).collect();
    let columns = [
        "method",
        "sets",
        "all relations right",
        "all goals right",
        "both",
        "single events: goal top-1",
        "relation",
    ];
    (!rows.is_empty()).then(|| Block::Table { head: head(&columns), rows })
}

fn part_table<S>(
    rows: &[Row<S>],
    pair: [Familiarity; 2],
    columns: [&str; 2],
    cells: impl Fn(&S) -> (usize, [String; 2]),
) -> Option<Block> {
    let part = |row: &Row<S>, familiarity: Familiarity| {
        let part = row.parts.iter().find(|part| part.familiarity == familiarity);
        part.map(|part| cells(&part.summary))
    };
    let shown = |row: &&Row<S>| {
        row.origin != Origin::Trained && pair.iter().any(|&familiarity| part(row, familiarity).is_some())
    };
    let line = |row: &Row<S>| -> Vec<String> {
        let cells =
            |familiarity| part(row, familiarity).map_or_else(|| [NOTHING; 2].map(Into::into), |it| it.1);
        [name(row)].into_iter().chain(pair.into_iter().flat_map(cells)).collect()
    };
    let lines: Vec<Vec<String>> = rows.iter().filter(shown).map(line).collect();
    let first = rows.iter().find(shown)?;
    let column = |familiarity: Familiarity| {
        let count = part(first, familiarity).map_or(0, |it| it.0);
        columns.map(|column| format!("{column}, {} ({count})", familiarity.description()))
    };
    let head = ["method".to_owned()].into_iter().chain(pair.into_iter().flat_map(column)).collect();
    Some(Block::Table { head, rows: lines })
}

/// Methods without a published counterpart.
fn others<S>(rows: &[Row<S>], has_place: impl Fn(&str) -> bool) -> Vec<&Row<S>> {
    let placed = |row: &Row<S>| row.origin == Origin::Ours && has_place(&row.method);
    let mut others: Vec<&Row<S>> =
        rows.iter().filter(|row| row.origin != Origin::Trained && !placed(row)).collect();
    others.sort_by(|a, b| (&a.method, a.set).cmp(&(&b.method, b.set)));
    others
}

pub(super) fn name<S>(row: &Row<S>) -> String {
    match row.origin {
        Origin::Ours => format!("{} (ours)", row.method),
        Origin::Trained => row.method.clone(),
        Origin::Given => format!("{} (predictions)", row.method),
    }
}

pub(super) fn events(benchmark: &Benchmark, set: usize, count: usize) -> String {
    format!("{} ({count})", label(benchmark, set))
}

fn seconds(seconds: Option<f64>) -> String {
    match seconds {
        Some(seconds) if seconds < 0.0005 => "below 0.001".into(),
        Some(seconds) if seconds < 0.1 => format!("{seconds:.3}"),
        Some(seconds) => format!("{seconds:.1}"),
        None => NOTHING.into(),
    }
}

fn cost(benchmark: &Benchmark, training: Option<usize>) -> String {
    let training = training.and_then(|training| benchmark.trainings.get(training));
    let describe = |training: &Training| {
        format!("{:.1} CPU min on {} events", training.cpu_seconds / 60.0, training.events)
    };
    training.map_or_else(|| NOTHING.into(), describe)
}
