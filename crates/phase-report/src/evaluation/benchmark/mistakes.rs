//! Error breakdown of the recognised goals.

use super::tables::{events, name};
use phase_document::document::{Block, head};
use phase_eval::{
    benchmark::{Benchmark, Origin},
    goals::ErrorBreakdown,
};

/// A table of all methods but those trained to show a curve; nothing without any.
pub(super) fn blocks(benchmark: &Benchmark) -> Vec<Block> {
    let Some(table) = table(benchmark) else { return Vec::new() };
    vec![
        Block::Heading("What goals were taken for".into()),
        Block::Text(
            "The goals thought likeliest, counted by agents, two to an event. The four columns after the right ones have \
             the kind of goal right (an agent on a landmark, here called a place; an object on one; touching); where the \
             landmark, the object or the agent is wrong, the sign may be too."
                .into(),
        ),
        table,
    ]
}

/// The table alone.
pub(super) fn table(benchmark: &Benchmark) -> Option<Block> {
    let shown = benchmark.goals.iter().filter(|row| row.origin != Origin::Trained);
    let rows: Vec<Vec<String>> = shown
        .filter_map(|row| {
            let counts = cells(row.mistakes.as_ref()?).into_iter().map(|count| count.to_string());
            let names = [name(row), events(benchmark, row.set, row.summary.all.n)];
            Some(names.into_iter().chain(counts).collect())
        })
        .collect();
    let columns = [
        "method",
        "events",
        "right",
        "sign wrong",
        "landmark wrong",
        "object or agent wrong",
        "both wrong",
        "place taken for object",
        "place for touch",
        "object for place",
        "object for touch",
        "touch for place",
        "touch for object",
        "none named",
    ];
    (!rows.is_empty()).then(|| Block::Table { head: head(&columns), rows })
}

/// The counts in the order of the columns.
fn cells(mistakes: &ErrorBreakdown) -> [usize; 12] {
    let ErrorBreakdown { right, sign, landmark, entity, both, kinds: [place, object, touch], nothing } =
        *mistakes;
    [
        right, sign, landmark, entity, both, place[1], place[2], object[0], object[2], touch[0], touch[1],
        nothing,
    ]
}
