//! Steps that both tasks have in common: ask a method event by event, store its answers, aggregate, report.

use super::{
    Evaluation,
    answers::AnswerSource,
    input::{Event, Input},
    scored::ScoredEvent,
    shards,
};
use crate::{
    error::RunError,
    event_writer::program,
    interrupt,
    listener::{Listener, Progress},
    parallel::{self, make_all},
    resume::is_finished,
    words,
};
use phase_dataset::shard::slots;
use phase_document::document::Document;
use phase_event::{MethodError, ProgressCallback, Recording};
use phase_files::{
    FileError, Problem, WriteError, atomic,
    checksum::{hexadecimal, sha256},
    folder::{self, Folder},
    json,
    run::Run,
};
use phase_model::{
    json::read_as,
    random::{Purpose, derive_seed},
};
use phase_report::evaluation::Subject;
use serde::{Serialize, de::DeserializeOwned};
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

/// The results' file name; it is written last.
const RESULTS_FILE: &str = "results.json";
/// CPU times of the answers: measured, and therefore apart from the results, which are the same in every run.
const TIMES_FILE: &str = "times.json";
/// The value of its field `format`.
const TIMES_FORMAT: &str = "phase-eval-times/1";
/// The report as a page.
pub const REPORT_FILE: &str = "report.html";
/// Folder of the stored answers.
pub(super) const EVENTS: &str = "events";

/// A task and the method that does it.
pub(crate) trait Task: Sync {
    /// Methods that do it.
    type Method: ?Sized;
    /// Their answers.
    type Answer: Clone;
    /// One event with the method's answer.
    type ScoredEvent: ScoredEvent;

    /// The task's name.
    const NAME: &'static str;

    /// The name of the questions in the names of folders.
    fn label(&self) -> &'static str {
        Self::NAME
    }

    /// The method or its answers.
    fn answers(&self) -> &AnswerSource<Self::Method, Self::Answer>;

    /// Everything that determines the answers beside events and seed.
    fn settings(&self) -> Value;

    /// About how often a method ticks for an event.
    fn ticks(&self) -> usize;

    /// Whether an event of a file can be evaluated.
    ///
    /// # Errors
    /// Describes the problem, continuing from the event's name.
    fn check(&self, event: &Event, file: &Path) -> Result<(), RunError>;

    /// Whether all that the task asks about can be read from an event of a file.
    ///
    /// # Errors
    /// Names the file, the event and the field.
    fn check_contents(&self, _recording: &Recording, _file: &Path) -> Result<(), RunError> {
        Ok(())
    }

    /// Runs the method; `None` if it was cancelled.
    ///
    /// # Errors
    ///
    /// If it has no answer, or an invalid one.
    fn ask(
        &self,
        event: &Event,
        recording: &Recording,
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> Result<Option<Self::ScoredEvent>, MethodError>;
}

/// An evaluation that is done.
#[derive(Clone, Debug)]
pub struct Evaluated<A> {
    /// Every event with the method's answer.
    pub events: Vec<A>,
    /// Results for programs, as in `results.json`.
    pub results: Value,
    /// The report for people.
    pub document: Document,
    /// The folder of both.
    pub folder: PathBuf,
    /// Whether it was done now.
    pub is_new: bool,
}

/// Does a task, or reuses its results if it is already done; `None` if only a part of it was requested.
pub(crate) fn evaluate<T: Task>(
    task: &T,
    input: &Input,
    evaluation: &Evaluation,
    listener: &dyn Listener,
) -> Result<Option<Evaluated<T::ScoredEvent>>, RunError> {
    input.events.iter().try_for_each(|event| task.check(event, &evaluation.events))?;
    let shard = evaluation.shard;
    let out = evaluation.out.clone().unwrap_or_else(|| default_folder(task, input, shard));
    let whole = Run::new([
        ("command", format!("eval {}", T::NAME).into()),
        ("generator", crate::engine::GENERATOR.into()),
        ("method", task.answers().name.as_str().into()),
        ("method_settings", task.settings()),
        ("seed", evaluation.seed.into()),
        ("n_events", input.events.len().into()),
        ("events_sha256", input.sha256.as_str().into()),
    ]);
    let subject = Subject {
        method: task.answers().name.as_str(),
        given: task.answers().is_external(),
        events: &input.description,
        seed: evaluation.seed,
    };
    let run = shards::run_of(&whole, shard);
    let last_file = if shard.is_some() { shards::SHARD_FILE } else { RESULTS_FILE };
    if is_finished(&out, last_file, &run, listener)? {
        if shard.is_none() {
            return finished(&whole, subject, out).map(Some);
        }
        run.check(&out, "a finished", &shards::read(&out)?.run())?;
        folder::remove_leftovers(&out, &run)?;
        return Ok(None);
    }
    let merged = shards::open(&evaluation.merge, &whole)?;
    let folder = Folder::claim(&out, &run)?;
    let kept = AnswerStore { folder: folder.subfolder(EVENTS)?, program: hexadecimal(&program()) };
    let (shard_number, of) = shard.unwrap_or((1, 1));
    let chosen: Vec<&Event> = slots(shard_number, of, input.events.len()).map(|k| &input.events[k]).collect();
    let activity = format!("evaluating {} on {}", task.answers().name.as_str(), words::events(chosen.len()));
    let progress = listener.progress(&activity, chosen.len(), task.ticks());
    let answered = make_all(parallel::threads(evaluation.threads), chosen.len(), |k| match &merged {
        Some(merged) => merged.store(k).load_or_fail(&chosen[k].id).map(Some),
        None => one(task, input, chosen[k], evaluation.seed, &kept, &*progress),
    })?;
    drop(progress);
    let Some(answered) = answered else { return Err(RunError::Interrupted(out)) };
    if let Some((number, of)) = shard {
        shards::write(&out, number, of, &whole, &kept.program)?;
        folder.finish()?;
        return Ok(None);
    }
    let (results, document) = summary(&whole, subject, &answered, &out)?;
    write_report(&out, &document)?;
    let times: BTreeMap<&str, f64> =
        answered.iter().filter_map(|event| Some((event.id(), event.clone().cpu_seconds().take()?))).collect();
    atomic::write_json(&out.join(TIMES_FILE), &json!({ "format": TIMES_FORMAT, "cpu_seconds": times }))?;
    atomic::write(&out.join(RESULTS_FILE), text_of(&results).as_bytes())?;
    folder.finish()?;
    Ok(Some(Evaluated { events: answered, results, document, folder: out, is_new: true }))
}

/// Results, without measured times, and report, with them.
fn summary<A: ScoredEvent>(
    run: &Run,
    subject: Subject<'_>,
    answered: &[A],
    out: &Path,
) -> Result<(Value, Document), RunError> {
    let mut untimed = answered.to_vec();
    untimed.iter_mut().for_each(|event| *event.cpu_seconds() = None);
    let sum_up = |events: &[A]| A::sum_up(events, subject.seed).ok_or_else(|| no_events(out));
    let results = A::results(run.value(), &sum_up(&untimed)?, &untimed);
    let results = results.map_err(|error| WriteError::json(&out.join(RESULTS_FILE), error))?;
    Ok((results, A::report(subject, &sum_up(answered)?)))
}

/// One event: its stored answer, or a new one that is stored.
fn one<T: Task>(
    task: &T,
    input: &Input,
    event: &Event,
    seed: u64,
    kept: &AnswerStore,
    progress: &dyn Progress,
) -> Result<Option<T::ScoredEvent>, RunError> {
    if let Some(answered) = kept.load(&event.id) {
        progress.event(0, &format!("{} (kept)", event.id));
        return Ok(Some(answered));
    }
    let recording = input.load(event)?;
    task.check_contents(&recording, &input.path)?;
    let mut counted = 0;
    let mut tick = || {
        counted += 1;
        progress.steps(1);
        interrupt::goes_on()
    };
    let asked = task.ask(event, &recording, event_seed(seed, &event.id), &mut tick);
    let answered = asked.map_err(|source| RunError::Method { id: event.id.clone(), source })?;
    let Some(answered) = answered else { return Ok(None) };
    kept.store(&event.id, &answered)?;
    progress.event(counted, &event.id);
    Ok(Some(answered))
}

/// The seed of one event, by its name alone: it is the same whatever else is evaluated.
pub(crate) fn event_seed(seed: u64, id: &str) -> u64 {
    let hash = sha256(id.as_bytes());
    let index = hash.iter().take(8).fold(0, |word: u64, &byte| word << 8 | u64::from(byte));
    derive_seed(seed, Purpose::Evaluation, index)
}

/// The stored answers, in a file for each event.
pub(super) struct AnswerStore {
    pub(super) folder: PathBuf,
    /// Digest of the executable; answers of another build are ignored.
    pub(super) program: String,
}

impl AnswerStore {
    fn path(&self, id: &str) -> PathBuf {
        self.folder.join(format!("{id}.json"))
    }

    /// An answer that has to be there.
    ///
    /// # Errors
    /// If it is not, or not of this build.
    fn load_or_fail<A: DeserializeOwned>(&self, id: &str) -> Result<A, RunError> {
        self.load(id).ok_or_else(|| {
            let rule = "it is no answer of this part of the evaluation to this event".into();
            let problem = Problem::Shape { what: "answer", rule };
            RunError::File(FileError { file: self.path(id), problem })
        })
    }

    fn load<A: DeserializeOwned>(&self, id: &str) -> Option<A> {
        let mut value = json::read(&self.path(id)).ok()?;
        let ours = value["program"] == *self.program && value["event"]["id"] == *id;
        ours.then(|| serde_json::from_value(value["event"].take()).ok()).flatten()
    }

    fn store(&self, id: &str, answered: &impl Serialize) -> Result<(), RunError> {
        let text = json!({ "program": self.program, "event": answered });
        Ok(atomic::write(&self.path(id), format!("{text:#}\n").as_bytes())?)
    }
}

/// Writes a report as Markdown and as a page, and its plots.
pub(crate) fn write_report(out: &Path, document: &Document) -> Result<(), RunError> {
    for (file, svg) in document.plots() {
        atomic::write(&out.join(file), svg.as_bytes())?;
    }
    atomic::write(&out.join("report.md"), document.to_markdown().as_bytes())?;
    Ok(atomic::write(&out.join(REPORT_FILE), document.to_html().as_bytes())?)
}

/// A finished folder of the same run is used unchanged.
fn finished<A: ScoredEvent>(run: &Run, subject: Subject<'_>, out: PathBuf) -> Result<Evaluated<A>, RunError> {
    let file = out.join(RESULTS_FILE);
    let results = json::read(&file)?;
    run.check(&out, "a finished", &results["run"])?;
    let altered = |rule: String| {
        let problem = Problem::Shape { what: "results file", rule };
        RunError::Altered(FileError { file: file.clone(), problem })
    };
    let mut events: Vec<A> =
        read_as(results["events"].clone()).map_err(|error| altered(error.to_string()))?;
    // Times are only for the report; without their file there are none.
    let times = json::read(&out.join(TIMES_FILE)).unwrap_or_default();
    for event in &mut events {
        let seconds = times["cpu_seconds"][event.id()].as_f64();
        *event.cpu_seconds() = seconds;
    }
    let (again, document) = summary(run, subject, &events, &out)?;
    if again != results {
        return Err(altered("its figures are not those of its events".into()));
    }
    folder::remove_leftovers(&out, run)?;
    Ok(Evaluated { events, results, document, folder: out, is_new: false })
}

fn no_events(out: &Path) -> RunError {
    RunError::Usage(format!("{}: there are no events to sum up", out.display()))
}

/// A folder in `out/eval`. The name of a method may be that of a file of predictions, which does not decide
/// where anything is written: what may mean something in a path becomes `-`.
fn default_folder<T: Task>(task: &T, input: &Input, shard: Option<(usize, usize)>) -> PathBuf {
    let shard = shard.map_or_else(String::new, |(number, of)| format!("-shard{number}of{of}"));
    let name = format!("{}-{}-{}{shard}", task.label(), task.answers().name.as_str(), input.name);
    let plain = |letter: char| if letter.is_alphanumeric() || "-_.".contains(letter) { letter } else { '-' };
    Path::new("out/eval").join(name.chars().map(plain).collect::<String>())
}

fn text_of(results: &Value) -> String {
    format!("{results:#}\n")
}
