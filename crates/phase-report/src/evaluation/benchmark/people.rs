//! Roles, calibration and agreement with people.

use super::{
    super::share,
    tables::{NOTHING, events, name},
};
use phase_document::document::{Block, head};
use phase_eval::{
    Estimate,
    benchmark::{Benchmark, Origin, Row},
    goals::{Agreement, Ceiling, Protocol, RecognitionSummary},
};

/// Both tables with their heading; nothing where no method tells the agent that helps or hinders and no
/// people were asked.
pub(super) fn blocks(benchmark: &Benchmark) -> Vec<Block> {
    let tables: Vec<Block> = roles(benchmark).into_iter().chain(agreement(benchmark)).collect();
    if tables.is_empty() {
        return tables;
    }
    let heading = Block::Heading("Roles, calibration, and agreement with people".into());
    let people = Block::Text(
        "People: how well one half of the raters predicts the other, and the entropy of their ratings, the least \
         cross-entropy that is possible."
            .into(),
    );
    [heading].into_iter().chain(tables).chain([people]).collect()
}

/// Roles and calibration; nothing unless some method tells the agent that helps or hinders.
pub(super) fn roles(benchmark: &Benchmark) -> Option<Block> {
    rows(benchmark).find(|row| row.summary.roles.is_some())?;
    let line = |row: &Row<RecognitionSummary>| {
        let summary = &row.summary;
        vec![
            name(row),
            events(benchmark, row.set, summary.all.n),
            or_nothing(summary.roles.as_ref().map(|roles| roles.named)),
            or_nothing(summary.roles.as_ref().map(|roles| roles.brier)),
            number(summary.goal_calibration.error),
            number(summary.relation_calibration.error),
        ]
    };
    let columns = [
        "method",
        "events",
        "helper or hinderer named",
        "Brier score",
        "calibration error, goals",
        "calibration error, relations",
    ];
    Some(Block::Table { head: head(&columns), rows: rows(benchmark).map(line).collect() })
}

/// Agreement with people's ratings, people's own first; nothing where no people were asked. Where a method
/// predicts reports, its posterior of the relation has a row of its own.
pub(super) fn agreement(benchmark: &Benchmark) -> Option<Block> {
    let ceiling = rows(benchmark).find_map(|row| row.summary.agreement.as_ref()?.ceiling)?;
    let lines = rows(benchmark).flat_map(|row| {
        let summary = &row.summary;
        let name = name(row);
        let posterior = summary.relation_agreement.as_ref();
        let reports =
            if posterior.is_some() { format!("{name}, the reports that it predicts") } else { name.clone() };
        // Where a model was fitted to the ratings, other models tell how good it is.
        let agreement = summary.held_out_agreement.as_ref().or(summary.agreement.as_ref());
        let own = agreement.map(|agreement| line(reports + of(agreement.protocol), agreement));
        let posterior =
            posterior.map(|agreement| line(format!("{name}, its posterior of the relation"), agreement));
        own.into_iter().chain(posterior)
    });
    let columns =
        ["method", "correlation", "cross-entropy (nat)", "similarity", "most frequent rating named"];
    Some(Block::Table { head: head(&columns), rows: [people(ceiling)].into_iter().chain(lines).collect() })
}

/// The protocol of a row in words, after its name.
const fn of(protocol: Protocol) -> &'static str {
    match protocol {
        Protocol::Unfitted => "",
        Protocol::InSample => ", in-sample",
        Protocol::HeldOut { .. } => ", held out",
    }
}

/// Explanation of the protocol of predicted reports, for prose; nothing where no model was fitted to the
/// ratings.
pub(super) fn protocol(benchmark: &Benchmark) -> Option<String> {
    let summaries = rows(benchmark).map(|row| &row.summary);
    let mut shown = summaries.filter_map(|it| it.held_out_agreement.as_ref().or(it.agreement.as_ref()));
    shown.find_map(|agreement| match agreement.protocol {
        Protocol::Unfitted => None,
        Protocol::InSample => Some("which was fitted to these very ratings".into()),
        Protocol::HeldOut { folds } => Some(format!(
            "fitted {folds} times, each time without the ratings of the events that it then predicts"
        )),
    })
}

fn line(name: String, agreement: &Agreement) -> Vec<String> {
    vec![
        name,
        or_nothing(agreement.correlation),
        share(&agreement.cross_entropy),
        or_nothing(agreement.similarity),
        share(&agreement.mode),
    ]
}

fn people(ceiling: Ceiling) -> Vec<String> {
    let or_nothing = |value: Option<f64>| value.map_or_else(|| NOTHING.into(), number);
    vec![
        "people".into(),
        or_nothing(ceiling.correlation),
        number(ceiling.entropy),
        or_nothing(ceiling.similarity),
        number(ceiling.mode),
    ]
}

fn rows(benchmark: &Benchmark) -> impl Iterator<Item = &Row<RecognitionSummary>> {
    benchmark.goals.iter().filter(|row| row.origin != Origin::Trained)
}

fn or_nothing(estimate: Option<Estimate>) -> String {
    estimate.map_or_else(|| NOTHING.into(), |it| share(&it))
}

fn number(value: f64) -> String {
    format!("{value:.3}")
}
