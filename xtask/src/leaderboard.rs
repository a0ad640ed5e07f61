//! `leaderboard`: scores the predictions of methods from outside, which lie in `data/leaderboard`.
//!
//! A file is named `<set>/<task>/<method>.json`, where the set is the label of one of the benchmark's. Scores
//! are kept in `scores.json` beside them, with the digest of each file, so that the page can be written, and
//! checked, without the events.

use crate::{error::XtaskError, results};
use clap::{Args, Parser};
use phase_cli::{
    cli::Cli, console::print_message, context::Context, error::CliError, output::print_result,
    program::Interface,
};
use phase_eval::{
    Estimate,
    benchmark::{Benchmark, GENERATED, PAIRS, RECORDED},
};
use phase_files::{atomic, checksum::sha256_hex};
use phase_report::evaluation::{self, LEADERBOARD_FORMAT, Measures, Score, Scores, Source};
use serde_json::Value;
use std::{
    collections::BTreeMap,
    ffi::OsString,
    fs,
    path::{Path, PathBuf},
};

/// The page.
pub const PAGE: &str = "docs/results/leaderboard.md";
/// The folder of predictions and scores.
const FOLDER: &str = "data/leaderboard";
/// The scores in it.
const SCORES: &str = "scores.json";
/// Authors and sources of the methods, by their names.
const SOURCES: &str = "methods.json";
/// The tasks, as `eval` names them.
const TASKS: [&str; 2] = ["goals", "trajectories"];

/// Options of `leaderboard`.
#[derive(Args, Debug)]
pub struct Leaderboard {
    /// Folder of PHASE-500; predictions for its test events are scored
    #[arg(long, value_name = "DIR")]
    pub data: Option<PathBuf>,
    /// Folder of phase-pairs
    #[arg(long, value_name = "DIR")]
    pub pairs: Option<PathBuf>,
    /// The recordings (a phase-events/1 file)
    #[arg(long, value_name = "FILE")]
    pub real: Option<PathBuf>,
    /// Write nothing, and fail if a score is not the one in data/leaderboard/scores.json
    #[arg(long)]
    pub check: bool,
}

/// A file of predictions.
struct Predictions {
    set: &'static str,
    task: &'static str,
    method: String,
    file: PathBuf,
    sha256: String,
}

/// Scores what it has the events for; other scores stay as they are.
///
/// # Errors
/// [`XtaskError`] if a file cannot be used, predictions have no score and their events were not given, or,
/// with `--check`, a score differs.
pub fn run(options: &Leaderboard, context: &Context) -> Result<(), XtaskError> {
    let root = results::root();
    let benchmark = results::benchmark(root)?;
    let known = scores(root)?;
    let mut all = Scores { format: LEADERBOARD_FORMAT.into(), scores: Vec::new() };
    for predictions in predictions(root)? {
        let events = match predictions.set {
            GENERATED => &options.data,
            PAIRS => &options.pairs,
            _ => &options.real,
        };
        let stored = known.scores.iter().find(|score| predictions.is_scored_by(score));
        let score = match (events, stored) {
            (Some(events), _) => predictions.score(events, &benchmark, context)?,
            (None, Some(stored)) => {
                print_message(format!("{}: not scored again", predictions.file.display()));
                stored.clone()
            }
            (None, None) => {
                let rule = "has no score yet, and its events are not given; see --help";
                return Err(results::shape(&predictions.file, rule));
            }
        };
        all.scores.push(score);
    }
    let file = root.join(FOLDER).join(SCORES);
    if options.check && all != known {
        return Err(results::shape(&file, "is not what `cargo xtask leaderboard` writes"));
    }
    if options.check {
        print_result("the scores are those of the predictions")?;
        return Ok(());
    }
    atomic::write_json(&file, &all).map_err(CliError::Output)?;
    results::run(&results::Results { check: false })
}

/// The page of the stored scores, which must be those of the files of predictions.
///
/// # Errors
/// [`XtaskError`] if a file cannot be used, or its score is missing.
pub fn page(root: &Path, benchmark: &Benchmark) -> Result<String, XtaskError> {
    let scores = scores(root)?;
    let predictions = predictions(root)?;
    let file = root.join(FOLDER).join(SCORES);
    let is_scored = |it: &Predictions| scores.scores.iter().any(|score| it.is_scored_by(score));
    if let Some(missing) = predictions.iter().find(|it| !is_scored(it)) {
        return Err(results::shape(&file, &format!("lacks the score of {}", missing.file.display())));
    }
    if scores.scores.len() != predictions.len() {
        return Err(results::shape(&file, "has scores of predictions that are not there"));
    }
    let file = root.join(FOLDER).join(SOURCES);
    let sources: BTreeMap<String, Source> = results::read_json(&file)?;
    if let Some(unknown) = predictions.iter().find(|it| !sources.contains_key(&it.method)) {
        return Err(results::shape(&file, &format!("does not say who made {}", unknown.method)));
    }
    Ok(evaluation::leaderboard(benchmark, &scores, &sources))
}

fn scores(root: &Path) -> Result<Scores, XtaskError> {
    results::read_json(&root.join(FOLDER).join(SCORES))
}

/// All files of predictions, sorted.
fn predictions(root: &Path) -> Result<Vec<Predictions>, XtaskError> {
    let mut found = Vec::new();
    let sets = [GENERATED, RECORDED, PAIRS].into_iter();
    for (set, task) in sets.flat_map(|set| TASKS.map(|task| (set, task))) {
        // A folder that is not there holds no predictions.
        let entries = fs::read_dir(root.join(FOLDER).join(set).join(task)).into_iter().flatten().flatten();
        let files = entries.map(|entry| entry.path());
        for file in files.filter(|file| file.extension().is_some_and(|ending| ending == "json")) {
            let bytes = fs::read(&file).map_err(XtaskError::unreadable(&file))?;
            let method = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            found.push(Predictions { set, task, method, file, sha256: sha256_hex(&bytes) });
        }
    }
    found.sort_by(|a, b| a.file.cmp(&b.file));
    Ok(found)
}

impl Predictions {
    fn is_scored_by(&self, score: &Score) -> bool {
        let task = match score.measures {
            Measures::Goals { .. } => TASKS[0],
            Measures::Trajectories { .. } => TASKS[1],
        };
        (self.set, self.task, &self.method, &self.sha256)
            == (&score.set, task, &score.method, &score.predictions)
    }

    /// Scores the predictions as `eval` does, on the events that the benchmark was run on.
    fn score(&self, events: &Path, benchmark: &Benchmark, context: &Context) -> Result<Score, XtaskError> {
        let folder = tempfile::tempdir().map_err(XtaskError::unreadable(Path::new("a temporary folder")))?;
        let out = folder.path().join("scored");
        let split: &[&str] = if self.set == GENERATED { &["--split", "test"] } else { &[] };
        let paths = [("--predictions", self.file.as_path()), ("--events", events), ("--out", &out)];
        let paths = paths.iter().flat_map(|(name, path)| [(*name).into(), path.as_os_str().to_owned()]);
        let words: Vec<OsString> =
            ["phase", "eval", self.task].iter().chain(split).map(OsString::from).chain(paths).collect();
        let command = Cli::try_parse_from(words).map_err(|error| CliError::Usage(error.to_string()))?.command;
        command.run(context)?;
        let results: Value = results::read_json(&out.join("results.json"))?;
        let digest = results["run"]["events_sha256"].as_str().unwrap_or_default().to_owned();
        let set = benchmark.sets.iter().find(|set| set.label == self.set);
        if set.is_some_and(|set| set.sha256 != digest) {
            return Err(results::shape(events, "does not have the events of data/results.json"));
        }
        let measures = measures(self.task, &results).ok_or_else(|| {
            results::shape(&self.file, "has results without the measures of the leaderboard")
        })?;
        let predictions = self.sha256.clone();
        Ok(Score { method: self.method.clone(), set: self.set.into(), predictions, events: digest, measures })
    }
}

/// The measures in the results of an evaluation.
fn measures(task: &str, results: &Value) -> Option<Measures> {
    let estimate = |pointer: &str| {
        let interval = results.pointer(&format!("/intervals{pointer}"))?;
        let value = results.pointer(pointer)?.as_f64()?;
        Some(Estimate { value, low: interval[0].as_f64()?, high: interval[1].as_f64()? })
    };
    Some(if task == TASKS[0] {
        Measures::Goals {
            top1: estimate("/goal/top1")?,
            relation: estimate("/relation/accuracy")?,
            whole_sets: serde_json::from_value(results["sets"]["all"].clone()).ok(),
        }
    } else {
        Measures::Trajectories { ade: estimate("/ade/all")?, fde: estimate("/fde/all")? }
    })
}
