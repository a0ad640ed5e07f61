//! Improvement of networks with the amount of training data.

use super::super::{length, share};
use phase_document::{
    document::{Block, head},
    plot::{Axis, Series, line_chart},
};
use phase_eval::{
    benchmark::{Benchmark, Origin, Row, Training},
    goals, trajectories,
};

/// Tables and plots; nothing unless there are networks trained for it.
pub(super) fn blocks(benchmark: &Benchmark) -> Vec<Block> {
    let trained = benchmark.goals.iter().any(|row| row.origin == Origin::Trained)
        || benchmark.trajectories.iter().any(|row| row.origin == Origin::Trained);
    if !trained {
        return Vec::new();
    }
    let mut blocks = vec![
        Block::Heading("As training data grows".into()),
        Block::Text(
            "Every network with as many events to learn from as said, the same stopping rule and the same validation \
             events; plots show the first set of events, axes from left to right grow by doubling."
                .into(),
        ),
    ];
    let Benchmark { goals, trajectories, .. } = benchmark;
    blocks.extend(table(
        benchmark,
        goals,
        ["goal top-1", "relation"],
        |summary: &goals::RecognitionSummary| [share(&summary.all.top1), share(&summary.all.relation)],
    ));
    blocks.extend(plot(
        benchmark,
        goals,
        "growth-goals.svg",
        "Goals right (most likely one)",
        ("share right", 1.0),
        |summary| summary.all.top1.value,
    ));
    blocks.extend(plot(
        benchmark,
        goals,
        "growth-relations.svg",
        "Relations right",
        ("share right", 1.0),
        |summary| summary.all.relation.value,
    ));
    blocks.extend(table(
        benchmark,
        trajectories,
        ["ADE", "FDE"],
        |summary: &trajectories::ForecastSummary| [length(&summary.all.ade), length(&summary.all.fde)],
    ));
    blocks.extend(plot(
        benchmark,
        trajectories,
        "growth-ade.svg",
        "ADE over all events",
        ("u", 0.0),
        |summary| summary.all.ade.value,
    ));
    blocks
}

/// The rows trained for this, by network and number of training events.
fn trained<'a, S>(benchmark: &'a Benchmark, rows: &'a [Row<S>]) -> Vec<(&'a Training, &'a Row<S>)> {
    let rows = rows.iter().filter(|row| row.origin == Origin::Trained);
    let with_training = |row: &'a Row<S>| Some((benchmark.trainings.get(row.training?)?, row));
    let mut rows: Vec<(&Training, &Row<S>)> = rows.filter_map(with_training).collect();
    rows.sort_by_key(|(training, row)| {
        (&training.network, &training.dataset, training.events, training.seed, row.set)
    });
    rows
}

fn table<S>(
    benchmark: &Benchmark,
    rows: &[Row<S>],
    columns: [&str; 2],
    cells: impl Fn(&S) -> [String; 2],
) -> Option<Block> {
    let line = |(training, row): (&Training, &Row<S>)| {
        let [first, second] = cells(&row.summary);
        let network = training.network.clone();
        let dataset = training.dataset.clone();
        vec![
            network,
            dataset,
            training.events.to_string(),
            super::label(benchmark, row.set).into(),
            first,
            second,
        ]
    };
    let rows: Vec<Vec<String>> = trained(benchmark, rows).into_iter().map(line).collect();
    let head = head(&["network", "learnt from", "events learnt from", "measured on", columns[0], columns[1]]);
    (!rows.is_empty()).then_some(Block::Table { head, rows })
}

/// A line for each network and dataset, and a horizontal one for SIMPLE, which is not trained on events. The
/// vertical axis has a unit and extends at least to the given value.
fn plot<S>(
    benchmark: &Benchmark,
    rows: &[Row<S>],
    file: &'static str,
    title: &str,
    (unit, top): (&str, f64),
    of: fn(&S) -> f64,
) -> Option<Block> {
    let points: Vec<(&Training, f64)> = trained(benchmark, rows)
        .into_iter()
        .filter(|(_, row)| row.set == 0)
        .map(|(training, row)| (training, of(&row.summary)))
        .collect();
    let least = points.iter().map(|(training, _)| training.events).min()? as f64;
    let most = points.iter().map(|(training, _)| training.events).max()? as f64;
    let mut lines: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
    for (training, value) in points {
        let name = match benchmark.trainings.iter().any(|other| other.dataset != training.dataset) {
            true => format!("{}, {}", training.network, training.dataset),
            false => training.network.clone(),
        };
        let point = (training.events as f64, value);
        match lines.iter_mut().find(|(other, _)| *other == name) {
            Some((_, line)) => line.push(point),
            None => lines.push((name, vec![point])),
        }
    }
    let simple = rows.iter().find(|row| row.origin == Origin::Ours && row.method == "simple" && row.set == 0);
    let simple = simple.map(|row| of(&row.summary));
    lines.extend(simple.map(|value| ("simple".into(), vec![(least, value), (most, value)])));
    let highest = lines.iter().flat_map(|(_, line)| line).map(|(_, value)| value.ceil()).fold(top, f64::max);
    let axes = [Axis::logarithmic("events learnt from", least, most), Axis::linear(unit, highest)];
    let series: Vec<Series<'_>> =
        lines.iter().map(|(name, points)| Series { name, points: points.clone() }).collect();
    Some(Block::Plot { file, title: title.into(), svg: line_chart(title, axes, &series) })
}
