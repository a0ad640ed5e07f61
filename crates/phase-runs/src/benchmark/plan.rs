//! Plan of a benchmark: the methods that are evaluated at each task.

use super::BenchmarkRun;
use crate::{effort::MindChoice, error::RunError, eval::networks};
use phase_minds::MindKind;
use phase_simple::Simple;
use std::path::PathBuf;

/// Every method of the benchmark.
pub const METHODS: [&str; 17] = [
    "simple",
    "simple-unguided",
    "simple-points",
    "simple-published",
    "simple-local",
    "simple-global",
    "simple-initial",
    "intent-network",
    "two-level-lstm",
    "arg",
    "socialgnn",
    "social-lstm",
    "stgat",
    "cue",
    "chance",
    "constant-velocity",
    "still",
];
/// Those of them that do each task.
const TASKS: [(BenchmarkTask, &[&str]); 2] = [
    (
        BenchmarkTask::Goals,
        &[
            "chance",
            "cue",
            "two-level-lstm",
            "arg",
            "intent-network",
            "socialgnn",
            "simple-initial",
            "simple-global",
            "simple-local",
            "simple-published",
            "simple-points",
            "simple-unguided",
            "simple",
        ],
    ),
    (BenchmarkTask::Trajectories, &["still", "constant-velocity", "social-lstm", "stgat", "simple"]),
];

/// The paper's two tasks.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum BenchmarkTask {
    /// Goals and relations.
    Goals,
    /// Trajectories.
    Trajectories,
}

/// One method at one task.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct BenchmarkEntry {
    /// The task.
    pub task: BenchmarkTask,
    /// Its name in the report.
    pub name: String,
    /// The method's own name.
    pub method: String,
    /// Weights other than the bundled ones.
    pub weights: Option<PathBuf>,
}

impl BenchmarkEntry {
    /// Description of the method.
    #[must_use]
    pub(super) fn description(&self) -> String {
        format!("{} by {}", self.task.name(), self.name)
    }
}

impl BenchmarkEntry {
    /// Whether the method is asked about sets that differ in one social variable: about goals, with its own
    /// weights, and without the variants of SIMPLE, which take several times as long.
    #[must_use]
    pub(super) fn does_pairs(&self) -> bool {
        self.task == BenchmarkTask::Goals && self.weights.is_none() && !self.method.starts_with("simple-")
    }
}

impl BenchmarkTask {
    /// The folder name of its evaluations.
    #[must_use]
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Goals => "goals",
            Self::Trajectories => "trajectories",
        }
    }
}

/// Whether any requested method is a neural network.
pub(super) fn needs_networks(run: &BenchmarkRun) -> bool {
    let mut names = networks::RECOGNISING.iter().chain(&networks::FORECASTING);
    !run.trained.is_empty() || names.any(|name| wanted(run, name))
}

/// All evaluations, the quickest first, so that errors show early.
pub(super) fn entries(run: &BenchmarkRun) -> Result<Vec<BenchmarkEntry>, RunError> {
    let mut entries = Vec::new();
    for file in &run.trained {
        let method = networks::training_of(file)?.network;
        let tasks = TASKS.iter().filter(|(_, methods)| methods.contains(&method.as_str()));
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        entries.extend(tasks.map(|(task, _)| BenchmarkEntry {
            task: *task,
            name: name.clone().into_owned(),
            method: method.clone(),
            weights: Some(file.clone()),
        }));
    }
    let own = TASKS.iter().flat_map(|(task, methods)| methods.iter().map(move |method| (*task, *method)));
    let own = own.filter(|(_, method)| wanted(run, method)).map(|(task, method)| BenchmarkEntry {
        task,
        name: minds_of(run, method, false).name(method),
        method: method.into(),
        weights: None,
    });
    entries.extend(own);
    // The six variants of SIMPLE take seconds for an event, the others less than a tenth of one.
    entries.sort_by_key(|entry| entry.method.starts_with("simple"));
    Ok(entries)
}

/// The minds that a method imagines in recordings or in generated events. Bodies in the recordings of the
/// published simulator turn one way, and the strongest coast; only SIMPLE has minds.
pub(super) fn minds_of(run: &BenchmarkRun, method: &str, recorded: bool) -> MindChoice {
    if !Simple::NAMES.contains(&method) {
        return MindChoice::default();
    }
    let as_recorded = recorded && run.minds == Some(MindKind::Published);
    MindChoice {
        kind: run.minds,
        one_way_turns: as_recorded,
        strongest_coasts: as_recorded,
        ..MindChoice::default()
    }
}

fn wanted(run: &BenchmarkRun, method: &str) -> bool {
    run.methods.is_empty() || run.methods.iter().any(|name| name == method)
}
