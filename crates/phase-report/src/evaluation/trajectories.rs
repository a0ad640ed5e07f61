//! The report of Task 2.

use super::{BESIDE, Subject, bars_beside, cost, length};
use crate::published;
use phase_document::{
    document::{Block, Document, head},
    plot::{Axis, Series, line_chart},
};
use phase_eval::{
    Estimate,
    trajectories::{ForecastScores, ForecastSummary, PREDICTED_STEPS, SampleScores, WATCHED_STEPS},
};
use phase_event::SAMPLES;

/// The report of how well a method predicts trajectories.
#[must_use]
pub fn trajectories(subject: Subject<'_>, summary: &ForecastSummary) -> Document {
    let ours = subject.label();
    let shorter = match summary.shorter {
        0 => String::new(),
        count => format!(
            " {count} of them end before step {}; of these as many steps are predicted as there are, and the last \
             of them is the final one.",
            WATCHED_STEPS + PREDICTED_STEPS
        ),
    };
    let mut blocks = vec![
        Block::Text(format!(
            "{}, seed {}: {} events. {WATCHED_STEPS} steps are watched, the next {PREDICTED_STEPS} predicted.{shorter} \
             ADE is the mean distance between predicted and true positions, FDE that of the last step, in u; every \
             event counts alike. Independent events are those with a neutral relation, social the others.",
            subject.events, subject.seed, summary.all.n
        )),
        beside_published(&ours, summary),
        Block::Text(BESIDE.into()),
        Block::Text(cost(summary.cpu_seconds_per_event)),
        published_plot("ade.svg", "ADE over all events, u", &ours, summary.all.ade.value, |row| row.ade[2]),
        published_plot("fde.svg", "FDE over all events, u", &ours, summary.all.fde.value, |row| row.fde[2]),
        Block::Heading("By kind of event".into()),
        kinds(summary),
        Block::Heading("As the prediction grows".into()),
    ];
    blocks.push(by_step(summary));
    if let Some(scores) = &summary.all.samples {
        blocks.push(Block::Heading("As a distribution".into()));
        blocks.extend(samples(scores, &summary.all));
    }
    Document { title: format!("Trajectories predicted by {}", subject.method), blocks }
}

fn beside_published(ours: &str, summary: &ForecastSummary) -> Block {
    let parts = [summary.independent.as_ref(), summary.social.as_ref(), Some(&summary.all)];
    let row = |name: String, ade: fn(&ForecastScores) -> &Estimate, fde: fn(&ForecastScores) -> &Estimate| {
        let cell = |part: &Option<&ForecastScores>, of: fn(&ForecastScores) -> &Estimate| {
            part.map_or_else(|| "-".into(), |scores| length(of(scores)))
        };
        let ade = parts.iter().map(|part| cell(part, ade));
        let fde = parts.iter().map(|part| cell(part, fde));
        [name].into_iter().chain(ade).chain(fde).chain(["this run".to_owned()]).collect()
    };
    let mut rows = vec![
        row(format!("{ours}, agents"), |scores| &scores.ade, |scores| &scores.fde),
        row(
            format!("{ours}, agents and objects"),
            |scores| &scores.ade_entities,
            |scores| &scores.fde_entities,
        ),
    ];
    rows.extend(published::TRAJECTORIES.iter().map(|row| {
        let numbers = row.ade.into_iter().chain(row.fde).map(|error| format!("{error:.2}"));
        [row.method.to_owned()].into_iter().chain(numbers).chain([row.source.to_owned()]).collect()
    }));
    let columns =
        ["method", "ADE independent", "social", "all", "FDE independent", "social", "all", "source"];
    Block::Table { head: head(&columns), rows }
}

/// Bars of lengths, PHASE's first.
fn published_plot(
    file: &'static str,
    title: &str,
    ours: &str,
    value: f64,
    theirs: fn(&published::TrajectoryRow) -> f64,
) -> Block {
    let published = published::TRAJECTORIES.iter().map(|row| (row.method, theirs(row)));
    bars_beside(file, title, " u", (ours, value), published)
}

/// Scores of the distribution of futures.
fn samples(scores: &SampleScores, agents: &ForecastScores) -> [Block; 2] {
    let rows = vec![
        vec!["one future (ADE, FDE)".into(), length(&agents.ade), length(&agents.fde), "-".into()],
        vec![
            format!("best of {SAMPLES} futures (minADE, minFDE)"),
            length(&scores.min_ade),
            length(&scores.min_fde),
            length(&scores.energy),
        ],
    ];
    let text = "The best of the futures is chosen for each agent. The energy score is proper: the less, the nearer the \
                distribution of futures to what happens; of one future it is the ADE.";
    let columns = ["agents", "average displacement", "final displacement", "energy score"];
    [Block::Text(text.into()), Block::Table { head: head(&columns), rows }]
}

fn kinds(summary: &ForecastSummary) -> Block {
    let rows = summary.kinds.iter().map(|group| {
        let scores = &group.scores;
        let errors = [&scores.ade, &scores.fde, &scores.ade_entities, &scores.fde_entities].map(length);
        [group.name.clone(), scores.n.to_string()].into_iter().chain(errors).collect()
    });
    let columns = ["kind", "events", "ADE agents", "FDE agents", "ADE agents and objects", "FDE"];
    Block::Table { head: head(&columns), rows: rows.collect() }
}

fn by_step(summary: &ForecastSummary) -> Block {
    let points: Vec<(f64, f64)> =
        summary.by_step.iter().enumerate().map(|(k, &error)| ((k + 1) as f64, error)).collect();
    let highest = points.iter().map(|(_, error)| error.ceil()).fold(1.0, f64::max);
    let title = "Error of the agents' positions by steps ahead";
    let axes = [Axis::linear("steps ahead", points.len().max(1) as f64), Axis::linear("error (u)", highest)];
    let series = [Series { name: "agents", points }];
    Block::Plot { file: "by-step.svg", title: title.into(), svg: line_chart(title, axes, &series) }
}
