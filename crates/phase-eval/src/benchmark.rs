//! Many methods on the same events, side by side: all that the benchmark's report says, as data.

use crate::{goals, trajectories};
use serde::Serialize;

/// The value of the field `format` of a benchmark.
pub const BENCHMARK_FORMAT: &str = "phase-benchmark/1";

/// A whole benchmark.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Benchmark {
    /// Always [`BENCHMARK_FORMAT`].
    pub format: &'static str,
    /// Name and version of the program.
    pub generator: String,
    /// Seed of methods and intervals.
    pub seed: u64,
    /// The events; the first are those of the dataset, the test split.
    pub sets: Vec<EventSet>,
    /// Task 1.
    pub goals: Vec<Row<goals::RecognitionSummary>>,
    /// Task 2.
    pub trajectories: Vec<Row<trajectories::ForecastSummary>>,
    /// What the networks among the methods cost, and how they learnt.
    pub trainings: Vec<Training>,
}

/// Some events.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct EventSet {
    /// In words.
    pub name: String,
    /// What they are called in a table.
    pub label: String,
    /// Stands for everything in them.
    pub sha256: String,
    /// How many there are.
    pub events: usize,
}

/// Where a row comes from.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// A method that comes with the program.
    Ours,
    /// One of our networks with weights from elsewhere: a point of a learning curve.
    Trained,
    /// Somebody else's method.
    Given,
}

/// One method on one set of events.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Row<S> {
    /// The method's name.
    pub method: String,
    /// Where it comes from.
    pub origin: Origin,
    /// Which of [`Benchmark::sets`].
    pub set: usize,
    /// Which of [`Benchmark::trainings`] is its own, if it learnt anything.
    pub training: Option<usize>,
    /// How well it does.
    pub summary: S,
    /// Error breakdown of its goals; Task 1 only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mistakes: Option<goals::ErrorBreakdown>,
    /// Scores on events with seen and unseen layouts or interaction types; empty if unknown.
    pub parts: Vec<Subset<S>>,
}

/// Some of a set's events.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Subset<S> {
    /// What they have in common.
    pub familiarity: Familiarity,
    /// How well the method does on them.
    pub summary: S,
}

/// What an event has in common with the training and validation events.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Familiarity {
    /// Its base layout.
    SeenLayout,
    /// Not even its base layout.
    UnseenLayout,
    /// Its type of interaction.
    SeenInteraction,
    /// Not even its type of interaction.
    UnseenInteraction,
}

/// How a network was trained.
#[derive(Clone, PartialEq, Debug, Serialize)]
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
    /// Events of a round.
    pub round: usize,
    /// Rounds.
    pub rounds: usize,
    /// The round whose weights were kept.
    pub best_round: Option<usize>,
    /// CPU time of all rounds (s).
    pub cpu_seconds: f64,
    /// What was measured after each round, in the order of rounds.
    pub curves: Vec<Curve>,
}

/// A measure over the rounds of a training.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Curve {
    /// What is measured.
    pub measure: String,
    /// On the training events, during training.
    pub training: Vec<f64>,
    /// On the validation events.
    pub validation: Vec<f64>,
}

impl Familiarity {
    /// All of them, in the order of reports.
    pub const ALL: [Self; 4] =
        [Self::SeenLayout, Self::UnseenLayout, Self::SeenInteraction, Self::UnseenInteraction];

    /// What is like and what is unlike, layouts and interactions apart.
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
