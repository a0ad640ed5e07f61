//! A benchmark of questions about events, in the forms that evaluators of language and vision-language models
//! read.

mod answers;
mod facts;
mod forms;
mod guess;
mod kept;
mod scoring;
mod videos;

pub(crate) use scoring::questions;
pub use scoring::{Scored, score_file};

use crate::{
    effort::MindChoice,
    error::RunError,
    eval::{
        methods::{FORECASTERS, forecaster, recogniser, recognisers},
        task::event_seed,
    },
    interrupt,
    laboratory::{Opened, clips::source_digest, open, unusable},
    listener::Listener,
    parallel::make_all,
    source::EventInput,
    words,
};
use answers::{Forms, Watcher};
use core::ops::ControlFlow;
use kept::Kept;
use phase_dataset::splits::Split;
use phase_files::{atomic, run::Run};
use phase_model::{
    State,
    arena::SUBSTEPS,
    random::{Purpose, stream},
    words::Names,
};
use phase_questions::{Facts, Query, Question, frames_needed};
use serde_json::{Value, json};
use std::{
    collections::{BTreeMap, BTreeSet},
    path::PathBuf,
};
use videos::Shown;

/// The description of a benchmark; written last.
pub const INDEX_FILE: &str = "questions.json";
/// The questions, one a line.
pub const QUESTIONS_FILE: &str = "questions.jsonl";
/// The value of the field `format` of the description.
const FORMAT: &str = "phase-questions/1";
/// The name of the method that guesses without motion.
pub const GUESS: &str = "guess";
/// The name of the method that answers what motion shows by the definitions of the answers, and what agents
/// have seen and believe by rules.
pub const RULES: &str = "rules";
/// The name of random answers.
const CHANCE: &str = "chance";

/// Names of everything whose answers can be written: methods for goals and relations, forecasters, which
/// answer what comes next, [`GUESS`] and [`RULES`].
#[must_use]
pub fn answerers() -> Vec<&'static str> {
    let known = recognisers();
    let forecasters = FORECASTERS.into_iter().filter(|name| !known.contains(name));
    let forecasters: Vec<&str> = forecasters.collect();
    known.into_iter().chain(forecasters).filter(|&name| name != CHANCE).chain([GUESS, RULES]).collect()
}

/// A run that asks questions about events.
#[derive(Clone, Debug)]
pub struct QuestionRun {
    /// Datasets, folders or files with events. Names of events are unique among all.
    pub events: Vec<PathBuf>,
    /// Only the events of this part, of datasets that are divided.
    pub split: Option<Split>,
    /// Ratings of events by people, in the form `phase-ratings/1`.
    pub ratings: Option<PathBuf>,
    /// The method that certifies numbers of frames for questions about relations and goals.
    pub certify: String,
    /// Methods whose answers are written, too, of [`answerers`].
    pub answers: Vec<String>,
    /// Most questions of each type.
    pub per_type: Option<usize>,
    /// Side of the pictures (pixels), even; no videos for 0.
    pub side: u32,
    /// Random seed of words and orders.
    pub seed: u64,
    /// The folder to write.
    pub out: PathBuf,
    /// Number of events at once.
    pub threads: usize,
}

/// A benchmark that is there.
#[derive(Clone, PartialEq, Debug)]
pub struct Asked {
    /// Number of questions of each type, types without any included.
    pub types: Vec<(&'static str, usize)>,
    /// Number of videos.
    pub videos: usize,
    /// Whether it was made now.
    pub is_new: bool,
}

/// A video: its events, and the last step that it shows.
type Video = (Vec<String>, Option<usize>);

impl QuestionRun {
    /// Makes the questions, their videos, and the files of every evaluator.
    ///
    /// # Errors
    /// If the events or the folder cannot be used, an event cannot be simulated, a file cannot be written, or
    /// a stop was requested. The same run goes on where it was interrupted.
    pub fn run(&self, listener: &dyn Listener) -> Result<Asked, RunError> {
        let sources = self.events.iter().map(|path| EventInput::open(path, &[], listener));
        let sources: Vec<EventInput> = sources.collect::<Result<_, _>>()?;
        facts::check_split(&self.events, self.split)?;
        let digests = sources.iter().map(source_digest).collect::<Result<Vec<_>, _>>()?;
        let run = Run::new([
            ("command", "questions".into()),
            ("events", json!(digests)),
            ("split", json!(self.split.map(Split::name))),
            ("ratings", self.ratings_digest()?),
            ("certify", self.certify.as_str().into()),
            ("answers", json!(self.answers)),
            ("per_type", json!(self.per_type)),
            ("side", self.side.into()),
            ("seed", self.seed.into()),
        ]);
        let folder = match open(&self.out, INDEX_FILE, &run)? {
            Opened::Done(done) => {
                let count = |name: &str| done["types"][name].as_u64().unwrap_or_default() as usize;
                let types = Query::TYPES.map(|name| (name, count(name))).to_vec();
                let videos = done["videos"].as_u64().unwrap_or_default() as usize;
                return Ok(Asked { types, videos, is_new: false });
            }
            Opened::Open(folder) => folder,
        };
        let kept = Kept::new(&folder);
        let facts = self.facts(&sources, &kept, listener)?;
        let mut random = stream(self.seed, Purpose::Evaluation, 0);
        let mut all = phase_questions::questions(&facts, &Names::PAPER, self.per_type, &mut random);
        if all.is_empty() {
            return Err(unusable(
                &self.events[0],
                "no question can be asked: every answer has to be as frequent as any other",
            ));
        }
        let by_id: BTreeMap<&str, &Facts> = facts.iter().map(|it| (it.id.as_str(), it)).collect();
        let mut certifying = None;
        let frames = match kept.frames(self.seed).filter(|frames| frames.len() == all.len()) {
            Some(frames) => frames,
            None => {
                let watcher = self.watcher(&self.certify, &by_id, &all, listener)?;
                let needed = |question: &Question| {
                    frames_needed(question, |event, budget| watcher.watch(event, question.until, budget))
                };
                let frames: Vec<_> = all.iter().map(needed).collect();
                kept.keep_frames(self.seed, &frames)?;
                certifying = Some(watcher);
                frames
            }
        };
        for (question, frames) in all.iter_mut().zip(frames) {
            question.frames = frames;
        }
        let mut names: BTreeMap<String, Video> = BTreeMap::new();
        for question in &all {
            names.insert(question.video.clone(), (question.events.clone(), question.until));
        }
        if self.side > 0 {
            self.videos(&names, &sources, &kept, listener)?;
        }
        let mut lines = String::new();
        for question in &all {
            lines += &line(question)?;
        }
        atomic::write(&self.out.join(QUESTIONS_FILE), lines.as_bytes())?;
        let types: Vec<(&'static str, usize)> = Query::TYPES
            .map(|name| (name, all.iter().filter(|it| it.query.type_name() == name).count()))
            .to_vec();
        forms::write(&self.out, &all, &by_id, self.side > 0, self.seed)?;
        let mut rows = Vec::new();
        for method in self.answers.iter().map(String::as_str).chain([CHANCE]) {
            let left = match kept.left_to_chance(method, self.seed) {
                Some(left) => left,
                None => {
                    let watcher = certifying.take_if(|_| method == self.certify);
                    let left = self.answer(method, watcher, &by_id, &all, listener)?;
                    kept.keep_left_to_chance(method, self.seed, left)?;
                    left
                }
            };
            rows.push(json!({ "method": method, "left_to_chance": left }));
        }
        let mut scores = Vec::new();
        for row in &rows {
            let method = row["method"].as_str().unwrap_or_default();
            let file = self.out.join(answers::FOLDER).join(format!("{method}.jsonl"));
            for row in score_file(&file, &self.out)?.score.rows {
                if !row.group.starts_with("frames ") {
                    let it = row.accuracy;
                    scores.push(json!({
                        "method": method, "control": row.control, "type": row.group, "right": it.right,
                        "of": it.of, "chance": it.chance,
                    }));
                }
            }
        }
        let count: BTreeMap<&str, usize> = types.iter().copied().collect();
        let index = json!({
            "format": FORMAT, "run": run, "questions": all.len(), "types": count, "videos": names.len(),
            "certified_by": self.certify, "answers": rows,
            "sha256": phase_files::checksum::sha256_hex(lines.as_bytes()), "scores": scores,
        });
        atomic::write_json(&self.out.join(INDEX_FILE), &index)?;
        folder.finish()?;
        Ok(Asked { types, videos: names.len(), is_new: true })
    }

    /// Writes the answers of a method, and returns how many it left to chance. `watcher` has its judgements,
    /// if it has been asked before.
    fn answer(
        &self,
        method: &str,
        watcher: Option<Watcher<'_>>,
        facts: &BTreeMap<&str, &Facts>,
        all: &[Question],
        listener: &dyn Listener,
    ) -> Result<usize, RunError> {
        match method {
            GUESS => answers::write_guesses(&self.out, all, facts),
            CHANCE => answers::write_chance(&self.out, all, self.seed),
            RULES => answers::write(&self.out, method, all, &Watcher::unjudged(facts, all), self.seed),
            _ if !recognisers().contains(&method) => self.forecasts(method, facts, all, listener),
            _ => {
                let watcher = match watcher {
                    Some(watcher) => watcher,
                    None => self.watcher(method, facts, all, listener)?,
                };
                answers::write(&self.out, method, all, &watcher, self.seed)
            }
        }
    }

    /// Writes the answers of a method that knows what comes next.
    fn forecasts(
        &self,
        method: &str,
        facts: &BTreeMap<&str, &Facts>,
        all: &[Question],
        listener: &dyn Listener,
    ) -> Result<usize, RunError> {
        let forecaster = forecaster(method, None, &MindChoice::default())?;
        let asked: Vec<&Question> =
            all.iter().filter(|question| matches!(question.query, Query::Ahead { .. })).collect();
        let progress =
            listener.progress_over(&format!("asking {method} about {} futures", asked.len()), asked.len());
        let made = make_all(self.threads, asked.len(), |index| {
            let question = asked[index];
            let Some(facts) = facts.get(question.events[0].as_str()) else { return Ok(Some(None)) };
            let seed = event_seed(self.seed, &facts.id);
            let choice = answers::forecast(forecaster.as_ref(), facts, question, seed, &mut goes_on);
            progress.steps(1);
            choice
        })?;
        drop(progress);
        let made = made.ok_or(RunError::Stopped(None))?;
        let choices: Vec<_> = asked.into_iter().zip(made).collect();
        answers::write_forecasts(&self.out, method, &choices, self.seed)
    }

    fn ratings_digest(&self) -> Result<Value, RunError> {
        let bytes = self.ratings.as_deref().map(phase_files::json::bytes).transpose()?;
        Ok(json!(bytes.map(|bytes| phase_files::checksum::sha256_hex(&bytes))))
    }

    /// Everything that is known of all events.
    fn facts(
        &self,
        sources: &[EventInput],
        kept: &Kept,
        listener: &dyn Listener,
    ) -> Result<Vec<Facts>, RunError> {
        let ratings = match &self.ratings {
            Some(file) => scoring::ratings(file)?,
            None => BTreeMap::new(),
        };
        let mut all: Vec<Facts> = Vec::new();
        let mut known = BTreeSet::new();
        for (path, source) in self.events.iter().zip(sources) {
            let units = facts::units(path, source, self.split)?;
            let count: usize = units.iter().map(|unit| unit.events.len()).sum();
            let progress = listener.progress_over(&format!("looking into {}", words::events(count)), count);
            let made = make_all(self.threads, units.len(), |index| {
                let unit = facts::of_unit(path, source, &units[index], &ratings, kept);
                progress.steps(units[index].events.len());
                unit
            })?;
            let made = made.ok_or(RunError::Stopped(None))?;
            for facts in made.into_iter().flatten() {
                if !known.insert(facts.id.to_ascii_lowercase()) {
                    return Err(unusable(path, &format!("event {} is in another input, too", facts.id)));
                }
                all.push(facts);
            }
        }
        Ok(all)
    }

    /// The judgements of a method about every event that a question shows which a judgement can answer.
    fn watcher<'a>(
        &self,
        method: &str,
        facts: &BTreeMap<&str, &'a Facts>,
        all: &[Question],
        listener: &dyn Listener,
    ) -> Result<Watcher<'a>, RunError> {
        let recogniser = recogniser(method, None, &MindChoice::default())?;
        let forms = match method == self.certify {
            false => Forms::Video,
            true if self.answers.contains(&self.certify) => Forms::BudgetsAndOrders,
            true => Forms::Budgets,
        };
        let shown = answers::all_shown(facts, all);
        let count = shown.iter().filter(|it| it.2).count();
        let progress = listener.progress_over(&format!("asking {method} about {count} videos"), count);
        let judged = make_all(self.threads, shown.len(), |index| {
            let (facts, until, is_judged) = shown[index];
            if !is_judged {
                return Ok(Some(Vec::new()));
            }
            let seed = event_seed(self.seed, &facts.id);
            let judged = answers::judge(recogniser.as_ref(), facts, until, forms, seed, &mut goes_on);
            progress.steps(1);
            judged
        })?;
        let judged = judged.ok_or(RunError::Stopped(None))?;
        Ok(Watcher::new(shown, judged))
    }

    fn videos(
        &self,
        names: &BTreeMap<String, Video>,
        sources: &[EventInput],
        kept: &Kept,
        listener: &dyn Listener,
    ) -> Result<(), RunError> {
        let places: BTreeMap<&str, (usize, usize)> = sources
            .iter()
            .enumerate()
            .flat_map(|(k, source)| (0..source.len()).map(move |index| (source.id(index), (k, index))))
            .collect();
        let names: Vec<(&String, &Video)> = names.iter().collect();
        let progress = listener.progress_over(&format!("drawing {} videos", names.len()), names.len());
        let made = make_all(self.threads, names.len(), |index| {
            let (name, (events, until)) = names[index];
            if interrupt::requested() {
                return Ok(None);
            }
            let shown =
                events.iter().filter_map(|event| places.get(event.as_str())).map(|&(source, index)| {
                    let recording = sources[source].load(index)?;
                    let frames = until.map_or(usize::MAX, |step| step * SUBSTEPS + 1);
                    let states: Vec<State> = recording.frames().take(frames).collect();
                    Ok(Shown { physics: recording.scene.physics(), states })
                });
            if !kept.has_videos(name, self.seed) {
                let shown: Vec<Shown> = shown.collect::<Result<_, RunError>>()?;
                videos::write(&self.out, name, &shown, self.side, event_seed(self.seed, name))?;
                kept.keep_videos(name, self.seed)?;
            }
            progress.steps(1);
            Ok(Some(()))
        })?;
        drop(progress);
        made.map(|_| ()).ok_or(RunError::Stopped(None))
    }
}

fn goes_on() -> ControlFlow<()> {
    if interrupt::requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

/// A value as a line of a JSONL file.
fn line(value: &impl serde::Serialize) -> Result<String, RunError> {
    let text = serde_json::to_string(value);
    let text = text.map_err(|source| RunError::Serialise { what: "a question", source })?;
    Ok(text + "\n")
}
