//! The benchmark in a few rows.

use crate::published;
use phase_document::document::{Block, head};
use phase_eval::benchmark::{Benchmark, Origin, RECORDED};

/// The published rows, and their names here.
const PUBLISHED: [(&str, &str); 4] = [
    ("humans", "people"),
    ("SIMPLE", "SIMPLE, published"),
    ("2-Level LSTM", "2-Level LSTM, published"),
    ("ARG", "ARG, published"),
];
/// Our method, its name beside the published ones, and the published row that it is put below.
const OURS: (&str, &str, &str) = ("simple", "SIMPLE, ours", "SIMPLE");

/// Goals and relations of the recordings: people, what is published, and `simple`.
#[must_use]
pub fn overview(benchmark: &Benchmark) -> Block {
    let line = |name: &str, goals: f64, relations: f64| {
        vec![name.to_owned(), format!("{goals:.3}"), format!("{relations:.2}")]
    };
    let recorded = benchmark.sets.iter().position(|set| set.label == RECORDED);
    let ours = || {
        let rows = benchmark
            .goals
            .iter()
            .filter(|row| row.origin == Origin::Ours && row.method == OURS.0 && Some(row.set) == recorded);
        rows.map(|row| line(OURS.1, row.summary.all.top1.value, row.summary.all.relation.value))
    };
    let rows = PUBLISHED.iter().flat_map(|(method, name)| {
        let row = published::GOALS.iter().find(|row| row.method == *method);
        let row = row.map(|row| line(name, row.goal[0], row.relation));
        row.into_iter().chain(ours().filter(|_| *method == OURS.2))
    });
    Block::Table { head: head(&["", "goals (top-1)", "relations"]), rows: rows.collect() }
}
