//! `leaderboard`: scores the predictions of methods from outside, which lie in `data/leaderboard`.
//!
//! A file is named `<set>/<task>/<method>.json`, where the set is the label of one of the benchmark's. Scores
//! are kept in `scores.json` beside them, with the digest of each file, so that the page can be written, and
//! checked, without the events.

use crate::{error::XtaskError, results};
use clap::Args;
use phase_cli::{console::print_message, context::Context, error::CliError, output::print_result};
use phase_eval::benchmark::{Benchmark, GENERATED, PAIRS, RECORDED};
use phase_files::atomic;
use phase_report::evaluation::{self, LEADERBOARD_FORMAT, Score, Scores, Source};
pub use phase_runs::leaderboard::PAGE;
use phase_runs::leaderboard::{FOLDER, Predictions, SCORES, SOURCES, predictions};
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

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
    for predictions in predictions(root).map_err(CliError::Run)? {
        let events = match predictions.set.as_str() {
            GENERATED => &options.data,
            PAIRS => &options.pairs,
            RECORDED => &options.real,
            // Sealed events are scored by `submit`, with the proof of the seal.
            _ => &None,
        };
        let stored = known.scores.iter().find(|score| predictions.is_scored_by(score));
        let score = match (events, stored) {
            (Some(events), _) => score(&predictions, events, &benchmark, context)?,
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
    let predictions = predictions(root).map_err(CliError::Run)?;
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

/// Scores predictions on the events that the benchmark was run on.
fn score(
    predictions: &Predictions,
    events: &Path,
    benchmark: &Benchmark,
    context: &Context,
) -> Result<Score, XtaskError> {
    let score = predictions.score(events, context).map_err(CliError::Run)?;
    let set = benchmark.sets.iter().find(|set| set.label == predictions.set);
    if set.is_some_and(|set| set.sha256 != score.events) {
        return Err(results::shape(events, "does not have the events of data/results.json"));
    }
    Ok(score)
}
