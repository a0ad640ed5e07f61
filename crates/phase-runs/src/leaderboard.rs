//! The leaderboard's files: predictions of methods from outside, their scores, and the page.
//!
//! They lie in a checkout, or in a folder of the same structure, from which a submission is copied into one.

mod files;
mod sealed;

pub use sealed::Sealed;

use crate::{
    error::RunError,
    eval::{Answers, Evaluation},
    listener::{Listener, Silent},
    source::EventInput,
};
use files::{bundled, there_or_bundled, unfit, write};
use phase_dataset::{
    manifest::{MANIFEST_FILE, Manifest},
    splits::Split,
};
use phase_eval::{
    Estimate,
    benchmark::{Benchmark, EventSet, GENERATED, PAIRS, RECORDED},
};
use phase_event::check_id;
use phase_files::{WriteError, checksum::sha256_hex, incidental::is_incidental, json};
use phase_report::evaluation::{self, LEADERBOARD_FORMAT, Measures, Score, Scores, SealedSet, Source};
use sealed::Opened;
use serde_json::Value;
use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

/// The page.
pub const PAGE: &str = "docs/results/leaderboard.md";
/// The folder of predictions and scores.
pub const FOLDER: &str = "data/leaderboard";
/// The file of scores in [`FOLDER`].
pub const SCORES: &str = "scores.json";
/// The file in [`FOLDER`] with authors and sources of the methods, by their names.
pub const SOURCES: &str = "methods.json";
/// The tasks, as `eval` names them.
pub const TASKS: [&str; 2] = ["goals", "trajectories"];
/// The member of predictions that answers each task.
const ANSWERS: [&str; 2] = ["goals", "forecast"];
/// A set of events that methods are scored on.
struct Set {
    /// Its label in the benchmark.
    label: &'static str,
    /// The preset of its dataset; without one the set is a file of recordings.
    preset: Option<&'static str>,
    /// The part of the dataset.
    split: Option<Split>,
    /// The command that makes it.
    made_by: &'static str,
}

/// The sets.
const SETS: [Set; 3] = [
    Set {
        label: GENERATED,
        preset: Some("phase-500"),
        split: Some(Split::Test),
        made_by: "`gen-dataset --preset phase-500 --no-video`",
    },
    Set {
        label: PAIRS,
        preset: Some("phase-pairs"),
        split: None,
        made_by: "`gen-dataset --preset phase-pairs --no-video`",
    },
    Set { label: RECORDED, preset: None, split: None, made_by: "`data/import_socialgnn.py`" },
];

/// The seed of the generated sets.
const SEED: u64 = 1;

/// A file of predictions to be scored on one of the sets.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Predictions {
    /// The label of the set.
    pub set: String,
    /// One of [`TASKS`].
    pub task: &'static str,
    /// The name of the method.
    pub method: String,
    /// The file.
    pub file: PathBuf,
    /// SHA-256 of the file.
    pub sha256: String,
}

impl Predictions {
    /// Whether a score is that of this file.
    #[must_use]
    pub fn is_scored_by(&self, score: &Score) -> bool {
        (&self.set, self.task, &self.method, &self.sha256)
            == (&score.set, task_of(score), &score.method, &score.predictions)
    }

    /// Scores the predictions as `eval` does.
    ///
    /// # Errors
    /// If the events or the predictions cannot be used.
    pub fn score(&self, events: &Path, listener: &dyn Listener) -> Result<Score, RunError> {
        let split = SETS.iter().find(|set| set.label == self.set).and_then(|set| set.split);
        self.score_as(Evaluation { split, ..Evaluation::new(events) }, None, listener)
    }

    fn score_as(
        &self,
        evaluation: Evaluation,
        sealed: Option<SealedSet>,
        listener: &dyn Listener,
    ) -> Result<Score, RunError> {
        let unwritable = |source| {
            RunError::Output(WriteError { path: std::env::temp_dir(), action: "create a folder in", source })
        };
        let folder = tempfile::tempdir().map_err(unwritable)?;
        let evaluation = Evaluation { out: Some(folder.path().join("scored")), ..evaluation };
        let answers = Answers::Predictions(self.file.clone());
        let results = if self.task == TASKS[0] {
            evaluation.goals(&answers, listener)?.map(|done| done.results)
        } else {
            evaluation.trajectories(&answers, listener)?.map(|done| done.results)
        };
        let results = results.unwrap_or_default();
        let digest = results["run"]["events_sha256"].as_str().unwrap_or_default().to_owned();
        let measures = measures(self.task, &results)
            .ok_or_else(|| unfit(&self.file, "has results without the measures of the leaderboard"))?;
        let predictions = self.sha256.clone();
        let (method, set) = (self.method.clone(), self.set.clone());
        Ok(Score { method, set, predictions, events: digest, sealed, measures })
    }
}

/// All files of predictions in [`FOLDER`] of a checkout, in the order of scores.
///
/// # Errors
/// If one cannot be read.
pub fn predictions(root: &Path) -> Result<Vec<Predictions>, RunError> {
    let mut found = Vec::new();
    // A folder that is not there holds no predictions.
    let inside = |folder: &Path| fs::read_dir(folder).into_iter().flatten().flatten();
    let folder = root.join(FOLDER);
    let folders = inside(&folder).map(|entry| entry.file_name().to_string_lossy().into_owned());
    let sealed = folders.filter(|name| name.starts_with(sealed::SEALED));
    let sets = SETS.iter().map(|set| set.label.to_owned()).chain(sealed);
    for (set, task) in sets.flat_map(|set| TASKS.map(|task| (set.clone(), task))) {
        let entries = inside(&folder.join(&set).join(task));
        let files = entries.filter(|entry| !is_incidental(&entry.file_name())).map(|entry| entry.path());
        for file in files.filter(|file| file.extension().is_some_and(|ending| ending == "json")) {
            let sha256 = sha256_hex(&json::bytes(&file)?);
            let method = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            found.push(Predictions { set: set.clone(), task, method, file, sha256 });
        }
    }
    found.sort_by(|a, b| a.file.cmp(&b.file));
    Ok(found)
}

/// The task of a score.
const fn task_of(score: &Score) -> &'static str {
    match score.measures {
        Measures::Goals { .. } => TASKS[0],
        Measures::Trajectories { .. } => TASKS[1],
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

/// Answers of a method that are to enter the leaderboard.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Submission {
    /// A file of predictions, with answers to one or both tasks.
    pub predictions: PathBuf,
    /// The events that they are about: the folder of a dataset, or the file of the recordings.
    pub events: PathBuf,
    /// The seal, if the answers were given to the motion of a sealed dataset.
    pub sealed: Option<Sealed>,
    /// The name of the method; without it that of the file.
    pub method: Option<String>,
    /// The authors.
    pub by: String,
    /// Address of the method's code or description.
    pub source: String,
    /// A checkout, or another folder, into which the files of a pull request are written.
    pub out: PathBuf,
}

/// A submission that was checked, scored and written.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct Submitted {
    /// Its scores, one for each task that it answers.
    pub scores: Vec<Score>,
    /// The files of the pull request.
    #[serde(serialize_with = "as_text")]
    pub files: Vec<PathBuf>,
    /// Whether the events are, byte for byte, those that the leaderboard's other scores are of.
    pub same_events: bool,
}

fn as_text<S: serde::Serializer>(files: &[PathBuf], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(files.iter().map(|file| file.to_string_lossy()))
}

impl Submission {
    /// Checks and scores the predictions, and writes the files of a pull request: the predictions, their
    /// scores and those of others, the authors, and the page. Nothing is written unless all is valid.
    ///
    /// # Errors
    /// If the events are none of the leaderboard's, which the sentence names; if an event has no answer or an
    /// invalid one; if a name is invalid; and if a file cannot be read or written.
    pub fn submit(&self, listener: &dyn Listener) -> Result<Submitted, RunError> {
        let benchmark: Benchmark = bundled("data/results.json", phase_data::RESULTS)?;
        let about = match &self.sealed {
            Some(sealed) => About::Sealed(sealed.open(&self.events, &self.predictions, listener)?),
            None => set_of(&self.events, &benchmark)?,
        };
        for (name, text) in [("by", &self.by), ("source", &self.source)] {
            let plain = !text.trim().is_empty() && !text.chars().any(char::is_control);
            if !plain {
                return Err(RunError::Usage(format!("{name} must be a line of text, not {text:?}")));
            }
        }
        let stem = || self.predictions.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let method = self.method.clone().unwrap_or_else(stem);
        check_id(&method)
            .map_err(|rule| RunError::Usage(format!("the name of the method {rule}, not {method:?}")))?;
        let bytes = json::bytes(&self.predictions)?;
        let answered = tasks_of(&json::read(&self.predictions)?);
        if answered.is_empty() {
            return Err(unfit(&self.predictions, "has events with neither `goals` nor `forecast`"));
        }
        let goals_only = match &about {
            About::Known(set, _) if set.label == PAIRS => Some("minimal pairs"),
            About::Known(..) => None,
            // All motion is published, also what would have to be forecast.
            About::Sealed(_) => Some("sealed events"),
        };
        if let Some(events) = goals_only.filter(|_| answered.contains(&TASKS[1])) {
            if answered.len() == 1 {
                let rule = format!("has forecasts alone, but on {events} goals are scored only");
                return Err(unfit(&self.predictions, &rule));
            }
            listener.note(&format!("note: on {events} goals are scored only; the forecasts are left out"));
        }
        let mut scores = Vec::new();
        for task in answered.into_iter().filter(|task| goals_only.is_none() || *task == TASKS[0]) {
            let (method, file) = (method.clone(), self.predictions.clone());
            let predictions =
                |set: &str| Predictions { set: set.into(), task, method, file, sha256: sha256_hex(&bytes) };
            scores.push(match &about {
                About::Known(set, _) => predictions(set.label).score(&self.events, listener)?,
                About::Sealed(Opened { label, set, names }) => {
                    let evaluation = Evaluation { names: names.clone(), ..Evaluation::new(&self.events) };
                    predictions(label).score_as(evaluation, Some(set.clone()), listener)?
                }
            });
        }
        let same_events = match about {
            About::Known(_, set) => scores.iter().all(|score| score.events == set.sha256),
            // That has been proved.
            About::Sealed(_) => true,
        };
        // Another version may make other events of a preset; recordings are what they are.
        if let About::Known(Set { preset: None, .. }, EventSet { events: count, .. }) = about
            && !same_events
        {
            let events = self.events.display();
            return Err(RunError::Usage(format!(
                "{events}: its events are not the {count} recordings of the leaderboard, as `data/import_socialgnn.py` writes them"
            )));
        }
        let files = self.write(&benchmark, &method, &bytes, &scores)?;
        Ok(Submitted { scores, files, same_events })
    }

    fn write(
        &self,
        benchmark: &Benchmark,
        method: &str,
        bytes: &[u8],
        scores: &[Score],
    ) -> Result<Vec<PathBuf>, RunError> {
        let folder = self.out.join(FOLDER);
        let all = folder.join(SCORES);
        let mut known: Scores = there_or_bundled(&all, phase_data::LEADERBOARD_SCORES)?;
        let authors = folder.join(SOURCES);
        let mut sources: BTreeMap<String, Source> =
            there_or_bundled(&authors, phase_data::LEADERBOARD_METHODS)?;
        let source = Source { by: self.by.clone(), source: self.source.clone() };
        sources.insert(method.into(), source);
        let place = |score: &Score| (score.set.clone(), task_of(score), format!("{}.json", score.method));
        known.format = LEADERBOARD_FORMAT.into();
        known.scores.retain(|old| scores.iter().all(|score| place(score) != place(old)));
        known.scores.extend(scores.iter().cloned());
        known.scores.sort_by_key(place);
        let page = evaluation::leaderboard(benchmark, &known, &sources);
        let mut files = Vec::new();
        for score in scores {
            let file = folder.join(&score.set).join(task_of(score)).join(format!("{method}.json"));
            write(&file, bytes)?;
            files.push(file);
        }
        for (file, value) in [(authors, serde_json::to_value(&sources)), (all, serde_json::to_value(&known))]
        {
            let text = value.and_then(|value| serde_json::to_string_pretty(&value));
            let text = text.map_err(|error| RunError::Output(WriteError::json(&file, error)))?;
            write(&file, format!("{text}\n").as_bytes())?;
            files.push(file);
        }
        let file = self.out.join(PAGE);
        write(&file, page.as_bytes())?;
        files.push(file);
        Ok(files)
    }
}

/// The events of a submission.
enum About<'a> {
    /// A set that everybody has, also as it is in the benchmark.
    Known(&'static Set, &'a EventSet),
    /// A sealed dataset.
    Sealed(Opened),
}

/// The set that some events are.
fn set_of<'a>(events: &Path, benchmark: &'a Benchmark) -> Result<About<'a>, RunError> {
    let file = events.join(MANIFEST_FILE);
    let manifest = if file.is_file() { Some(Manifest::read(&file)?) } else { None };
    let preset = manifest.as_ref().map(|manifest| manifest.preset.as_str());
    let known =
        |set: &'static Set| Some((set, benchmark.sets.iter().find(|known| known.label == set.label)?));
    let wrong = |found: String| {
        let sets = SETS.iter().filter_map(known).map(|(set, EventSet { name, events, .. })| {
            // The file of the recordings has the name that somebody gave it.
            let name = if set.preset.is_some() { name } else { "the recordings" };
            format!("{events} of {name} (made by {})", set.made_by)
        });
        let expected = sets.collect::<Vec<_>>().join("; ");
        let path = events.display();
        RunError::Usage(format!("{path}: {found}; the events of the leaderboard are {expected}"))
    };
    let found = SETS.iter().find(|set| set.preset == preset).and_then(known);
    let Some((set, in_benchmark)) = found else {
        return Err(wrong(format!("has events of the preset {}", preset.unwrap_or_default())));
    };
    let count = match &manifest {
        Some(manifest) => {
            let events = manifest.events.iter();
            events.filter(|event| set.split.is_none_or(|split| event.split() == split)).count()
        }
        None => EventInput::open(events, &[], &Silent)?.len(),
    };
    if count != in_benchmark.events {
        return Err(wrong(format!("has {count} of them")));
    }
    match manifest {
        Some(manifest) if manifest.seed != SEED => {
            Err(wrong(format!("was made with the seed {}", manifest.seed)))
        }
        _ => Ok(About::Known(set, in_benchmark)),
    }
}

/// The tasks that predictions answer.
fn tasks_of(predictions: &Value) -> Vec<&'static str> {
    let first = &predictions["events"][0];
    let answered = TASKS.into_iter().zip(ANSWERS).filter(|(_, member)| !first[member].is_null());
    answered.map(|(task, _)| task).collect()
}
