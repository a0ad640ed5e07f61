//! Many methods on the same events, side by side: the contents of the benchmark's report, as data.

use crate::{goals, trajectories};
use serde::{Deserialize, Deserializer, Serialize, de};

/// The value of the field `format` of a benchmark.
pub const BENCHMARK_FORMAT: &str = "phase-benchmark/1";

/// The label of the test events of a dataset.
pub const GENERATED: &str = "generated";
/// The label of recordings.
pub const RECORDED: &str = "recorded";
/// The label of events in sets that differ in one social variable.
pub const PAIRS: &str = "pairs";

/// A whole benchmark.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Benchmark {
    /// Always [`BENCHMARK_FORMAT`].
    #[serde(deserialize_with = "own_format")]
    pub format: String,
    /// Name and version of the program.
    pub generator: String,
    /// The options that determine what is measured, as given on the command line.
    pub options: Vec<String>,
    /// Seed of methods and intervals.
    pub seed: u64,
    /// The events; the first are those of the dataset, the test split.
    pub sets: Vec<EventSet>,
    /// Task 1.
    pub goals: Vec<Row<goals::RecognitionSummary>>,
    /// Task 2.
    pub trajectories: Vec<Row<trajectories::ForecastSummary>>,
    /// The training cost and learning curves of the networks among the methods.
    pub trainings: Vec<Training>,
}

/// Some events.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct EventSet {
    /// In words.
    pub name: String,
    /// Their name in a table: [`GENERATED`], [`RECORDED`] or [`PAIRS`].
    pub label: String,
    /// Digest of the events.
    pub sha256: String,
    /// Number of events.
    pub events: usize,
}

/// The origin of a row.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// A method bundled with the program.
    Ours,
    /// One of PHASE's networks with other weights: a point of a learning curve.
    Trained,
    /// An external method.
    Given,
}

/// One method on one set of events.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Row<S> {
    /// The method's name.
    pub method: String,
    /// Its origin.
    pub origin: Origin,
    /// Index into [`Benchmark::sets`].
    pub set: usize,
    /// Index of its training in [`Benchmark::trainings`], if it was trained.
    pub training: Option<usize>,
    /// Its scores.
    pub summary: S,
    /// Error breakdown of its goals; Task 1 only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mistakes: Option<goals::ErrorBreakdown>,
    /// Scores on events with seen and unseen layouts or interaction types; empty if unknown.
    pub parts: Vec<Subset<S>>,
}

/// Some of a set's events.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Subset<S> {
    /// The name of what they have in common.
    pub familiarity: Familiarity,
    /// The method's scores on them.
    pub summary: S,
}

/// The parts of an event that occur in the training and validation events too.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Familiarity {
    /// Its base layout.
    SeenLayout,
    /// Its base layout does not occur there.
    UnseenLayout,
    /// Its type of interaction.
    SeenInteraction,
    /// Its type of interaction does not occur there.
    UnseenInteraction,
}

/// The training of a network.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Training {
    /// The kind of network.
    pub network: String,
    /// Number of trainable parameters.
    pub weights: usize,
    /// The seed.
    pub seed: u64,
    /// Name of the training dataset.
    pub dataset: String,
    /// Number of training events.
    pub events: usize,
    /// Events in a round.
    pub round: usize,
    /// Rounds.
    pub rounds: usize,
    /// The round whose weights were kept.
    pub best_round: Option<usize>,
    /// CPU time of all rounds (s).
    pub cpu_seconds: f64,
    /// The metrics after each round, in the order of rounds.
    pub curves: Vec<Curve>,
}

/// A metric over the rounds of a training.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Curve {
    /// The metric.
    pub measure: String,
    /// On the training events, during training.
    pub training: Vec<f64>,
    /// On the validation events.
    pub validation: Vec<f64>,
}

/// Reads the format, which must be [`BENCHMARK_FORMAT`].
fn own_format<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    let format = String::deserialize(deserializer)?;
    match format == BENCHMARK_FORMAT {
        true => Ok(format),
        false => {
            Err(de::Error::custom(format!("field `format` must be {BENCHMARK_FORMAT:?}, not {format:?}")))
        }
    }
}

impl Familiarity {
    /// All of them, in the order of reports.
    pub const ALL: [Self; 4] =
        [Self::SeenLayout, Self::UnseenLayout, Self::SeenInteraction, Self::UnseenInteraction];

    /// The similar and the dissimilar one, layouts and interactions apart.
    pub const PAIRS: [[Self; 2]; 2] =
        [[Self::SeenLayout, Self::UnseenLayout], [Self::SeenInteraction, Self::UnseenInteraction]];

    /// In words.
    #[must_use]
    pub const fn description(self) -> &'static str {
        match self {
            Self::SeenLayout => "seen layouts",
            Self::UnseenLayout => "unseen layouts",
            Self::SeenInteraction => "seen interaction types",
            Self::UnseenInteraction => "unseen interaction types",
        }
    }
}
