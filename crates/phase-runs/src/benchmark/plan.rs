//! Which methods are evaluated at which task.

use super::options::Benchmark;
use crate::{effort::MindOptions, error::CliError, eval::networks};
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
const TASKS: [(Task, &[&str]); 2] = [
    (
        Task::Goals,
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
    (Task::Trajectories, &["still", "constant-velocity", "social-lstm", "stgat", "simple"]),
];

/// The paper's two tasks.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Task {
    /// Goals and relations.
    Goals,
    /// Trajectories.
    Trajectories,
}

/// One method at one task.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct BenchmarkEntry {
    /// The task.
    pub task: Task,
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
    pub fn description(&self) -> String {
        format!("{} by {}", self.task.name(), self.name)
    }
}

impl BenchmarkEntry {
    /// Whether the method is asked about sets that differ in one social variable: about goals, with its own weights, and
    /// without the variants of SIMPLE, which take several times as long.
    #[must_use]
    pub fn does_pairs(&self) -> bool {
        self.task == Task::Goals && self.weights.is_none() && !self.method.starts_with("simple-")
    }
}

impl Task {
    /// The folder name of its evaluations.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Goals => "goals",
            Self::Trajectories => "trajectories",
        }
    }
}

/// Whether any requested method is a neural network.
#[must_use]
pub fn needs_networks(arguments: &Benchmark) -> bool {
    let mut names = networks::RECOGNISING.iter().chain(&networks::FORECASTING);
    !arguments.trained.is_empty() || names.any(|name| wanted(arguments, name))
}

/// All evaluations, the quickest first, so that errors show early.
///
/// # Errors
/// If a file of weights cannot be used.
pub fn entries(arguments: &Benchmark) -> Result<Vec<BenchmarkEntry>, CliError> {
    let mut entries = Vec::new();
    for file in &arguments.trained {
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
    let own = own.filter(|(_, method)| wanted(arguments, method)).map(|(task, method)| BenchmarkEntry {
        task,
        name: minds_of(arguments, method, false).name(method),
        method: method.into(),
        weights: None,
    });
    entries.extend(own);
    // The six variants of SIMPLE take seconds for an event, the others less than a tenth of one.
    entries.sort_by_key(|entry| entry.method.starts_with("simple"));
    Ok(entries)
}

/// The minds that a method imagines in recordings or in generated events. Bodies in the recordings of the published simulator
/// turn one way; only SIMPLE has minds.
#[must_use]
pub fn minds_of(arguments: &Benchmark, method: &str, recorded: bool) -> MindOptions {
    if !Simple::NAMES.contains(&method) {
        return MindOptions::default();
    }
    let one_way_turns = recorded && arguments.minds == Some(MindKind::Published);
    MindOptions { minds: arguments.minds, one_way_turns }
}

fn wanted(arguments: &Benchmark, method: &str) -> bool {
    arguments.methods.is_empty() || arguments.methods.iter().any(|name| name == method)
}
