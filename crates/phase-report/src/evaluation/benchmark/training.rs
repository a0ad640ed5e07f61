//! The training cost and learning curves of networks.

use phase_document::{
    document::{Block, head},
    plot::{Axis, Series, line_chart},
};
use phase_eval::benchmark::{Benchmark, Curve, Origin, Training};

/// A table of all trainings, and the curves of those whose weights are bundled; nothing without networks.
pub(super) fn blocks(benchmark: &Benchmark) -> Vec<Block> {
    let Some(table) = table(benchmark) else { return Vec::new() };
    let mut blocks = vec![
        Block::Heading("Training".into()),
        Block::Text(
            "A round is 320 events, however many there are to learn from; after each the validation events are measured, \
             and the weights of the best round are kept."
                .into(),
        ),
        table,
    ];
    for (index, training) in benchmark.trainings.iter().enumerate() {
        if let (true, Some(file)) = (is_ours(benchmark, index), file(&training.network)) {
            blocks.push(plot(training, file));
        }
    }
    blocks
}

/// Whether the weights are the bundled ones; plots of all others would be too many.
fn is_ours(benchmark: &Benchmark, training: usize) -> bool {
    let ours = |origin, index| origin == Origin::Ours && index == Some(training);
    benchmark.goals.iter().any(|row| ours(row.origin, row.training))
        || benchmark.trajectories.iter().any(|row| ours(row.origin, row.training))
}

/// Training cost of every network; nothing without networks.
pub(super) fn table(benchmark: &Benchmark) -> Option<Block> {
    let row = |training: &Training| {
        vec![
            training.network.clone(),
            training.weights.to_string(),
            format!("{}, seed {}", training.dataset, training.seed),
            training.events.to_string(),
            training.rounds.to_string(),
            training.best_round.map_or_else(|| "–".into(), |round| round.to_string()),
            format!("{:.1}", training.cpu_seconds / 60.0),
        ]
    };
    let columns = ["network", "weights", "learnt from", "events", "rounds", "best", "CPU min"];
    let mut trainings: Vec<&Training> = benchmark.trainings.iter().collect();
    trainings.sort_by_key(|training| (&training.network, &training.dataset, training.events, training.seed));
    let rows: Vec<Vec<String>> = trainings.into_iter().map(row).collect();
    (!rows.is_empty()).then(|| Block::Table { head: head(&columns), rows })
}

fn plot(training: &Training, file: &'static str) -> Block {
    let points =
        |values: &[f64]| values.iter().enumerate().map(|(k, &value)| ((k + 1) as f64, value)).collect();
    let names: Vec<[String; 2]> = training
        .curves
        .iter()
        .map(|curve| ["training", "validation"].map(|part| format!("{}, {part}", curve.measure)))
        .collect();
    let series: Vec<Series<'_>> = training
        .curves
        .iter()
        .zip(&names)
        .flat_map(|(curve, [learnt, validated])| {
            [
                Series { name: learnt, points: points(&curve.training) },
                Series { name: validated, points: points(&curve.validation) },
            ]
        })
        .collect();
    let title = format!("How {} learnt", training.network);
    let axes = [
        Axis::linear("rounds", training.rounds.max(1) as f64),
        Axis::linear("measure", highest(&training.curves)),
    ];
    Block::Plot { file, svg: line_chart(&title, axes, &series), title }
}

/// Axes of shares end at 1, those of lengths at their maximum.
fn highest(curves: &[Curve]) -> f64 {
    let all = curves.iter().flat_map(|curve| curve.training.iter().chain(&curve.validation));
    all.copied().filter(|value| value.is_finite()).fold(1.0, |highest, value| f64::max(highest, value.ceil()))
}

fn file(network: &str) -> Option<&'static str> {
    match network {
        "two-level-lstm" => Some("training-two-level-lstm.svg"),
        "arg" => Some("training-arg.svg"),
        "socialgnn" => Some("training-socialgnn.svg"),
        "social-lstm" => Some("training-social-lstm.svg"),
        "stgat" => Some("training-stgat.svg"),
        _ => None,
    }
}
