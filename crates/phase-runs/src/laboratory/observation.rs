//! The observer's posterior and motion in time, as regressors.

use super::{
    Opened,
    answers::{answer_columns, answers, beliefs},
    clips::source_digest,
    open,
    presentation::Presentation,
    tables::{MISSING, Table, unusable},
    unfit,
};
use crate::{
    effort::MindChoice, error::RunError, interrupt, listener::Listener, parallel::make_all,
    source::EventInput, words,
};
use core::ops::ControlFlow;
use phase_event::{MethodError, ObservedEvent, Recogniser, Recording};
use phase_files::{atomic, checksum::sha256_hex, regular, run::Run};
use phase_laboratory::{
    clip::{Clip, Cut, Window, seconds_of},
    regressors::{self, COLUMNS as MOTION, FrameMotion},
};
use phase_model::{
    Judgement, State,
    arena::{FRAMES_PER_SECOND, SUBSTEPS},
};
use phase_simple::{Models, PreparedEvent, Simple};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

/// Written last: the tables are a derivative dataset of BIDS, which has such a file.
const SUMMARY_FILE: &str = "dataset_description.json";
/// The version of BIDS.
const BIDS_VERSION: &str = "1.10.0";
/// The value of its field `format`.
const SUMMARY_FORMAT: &str = "phase-observation/1";

/// An observing method.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ObservingMethod {
    /// SIMPLE.
    Simple,
    /// Its intent network alone.
    IntentNetwork,
}

/// A run that observes events in chunks of time.
#[derive(Clone, Debug)]
pub struct Observation {
    /// The events.
    pub events: PathBuf,
    /// Only these, if there are any.
    pub ids: Vec<String>,
    /// The clips to observe, if not whole events.
    pub cut: Option<Cut>,
    /// Length of a chunk (steps).
    pub every: usize,
    /// The observing method.
    pub method: ObservingMethod,
    /// The minds that SIMPLE imagines; by default it averages over both kinds.
    pub minds: MindChoice,
    /// Random seed of the observer.
    pub seed: u64,
    /// Times at which videos were shown, as the `*_events.tsv` of a run: `onset` and `stim_file`.
    pub presentations: Option<PathBuf>,
    /// The folder for the tables.
    pub out: PathBuf,
    /// Number of events at once.
    pub threads: usize,
}

/// Tables that are there.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Observed {
    /// Their names.
    pub files: Vec<String>,
    /// Number of chunks.
    pub chunks: usize,
    /// Whether they were made now.
    pub is_new: bool,
}

/// Everything about one event, kept until the run ends.
#[derive(Serialize, Deserialize)]
struct Course {
    id: String,
    chunks: Vec<Chunk>,
    /// Values of every frame, in the order of the regressors.
    frames: Vec<Vec<f64>>,
}

/// Everything known at the end of a chunk.
#[derive(Serialize, Deserialize)]
struct Chunk {
    /// Seconds from the beginning of the video.
    onset: f64,
    duration: f64,
    /// Answers, in the order of their columns; none where the method says nothing.
    answers: Vec<Option<f64>>,
    motion: Vec<f64>,
    activations: Vec<f64>,
}

impl Observation {
    /// Observes all events and writes the tables. Events that are done are kept after an interruption.
    ///
    /// # Errors
    /// If the events or the folder cannot be used, a file cannot be written, or a stop was requested.
    pub fn run(&self, listener: &dyn Listener) -> Result<Observed, RunError> {
        let source = EventInput::open(&self.events, &self.ids, listener)?;
        let presentations = self.presentations.as_deref().map(Presentation::read).transpose()?;
        let shown = match &self.presentations {
            Some(path) => sha256_hex(&regular::bytes(path)?),
            None => String::new(),
        };
        let simple = self.simple()?;
        let run = Run::new([
            ("command", "observe".into()),
            ("events", source_digest(&source)?.into()),
            ("cut", self.cut.map_or(Value::Null, |cut| format!("{cut:?}").into())),
            ("every", self.every.into()),
            ("method", json!(self.method)),
            ("settings", Recogniser::settings(&simple)),
            ("seed", self.seed.into()),
            ("presentations", shown.into()),
        ]);
        let folder = match open(&self.out, SUMMARY_FILE, &run)? {
            Opened::Done(done) => {
                let files = serde_json::from_value(done["files"].clone()).unwrap_or_default();
                let chunks = done["chunks"].as_u64().unwrap_or_default() as usize;
                return Ok(Observed { files, chunks, is_new: false });
            }
            Opened::Open(folder) => folder,
        };
        let models = Arc::new(Models::bundled()?);
        let cache = folder.cache();
        let activity = format!("observing {}", words::events(source.len()));
        let progress = listener.progress(&activity, source.len(), 1);
        let courses = make_all(self.threads, source.len(), |index| {
            let recording = source.load(index)?;
            let kept = cache.join(format!("{}.json", recording.id));
            let course = match phase_files::json::read(&kept)
                .ok()
                .and_then(|kept| serde_json::from_value(kept).ok())
            {
                Some(course) => course,
                None => match self.course(&recording, &simple, &models)? {
                    Some(course) => {
                        atomic::write_json(&kept, &course)?;
                        course
                    }
                    None => return Ok(None),
                },
            };
            progress.event(0, &recording.id);
            Ok(Some(course))
        })?;
        drop(progress);
        let courses: Vec<Course> = courses.ok_or_else(|| RunError::Interrupted(self.out.clone()))?;
        let files = self.write(&courses, presentations.as_deref())?;
        let chunks = courses.iter().map(|course| course.chunks.len()).sum();
        let summary = json!({
            "Name": "Social events as PHASE observes them",
            "BIDSVersion": BIDS_VERSION,
            "DatasetType": "derivative",
            "GeneratedBy": [{ "Name": "phase", "Version": env!("CARGO_PKG_VERSION") }],
            "format": SUMMARY_FORMAT, "run": run, "files": files, "chunks": chunks,
        });
        atomic::write_json(&self.out.join(SUMMARY_FILE), &summary)?;
        folder.finish()?;
        Ok(Observed { files, chunks, is_new: true })
    }

    /// SIMPLE with the minds that were asked for.
    fn simple(&self) -> Result<Simple, RunError> {
        if self.method == ObservingMethod::IntentNetwork && self.minds != MindChoice::default() {
            return Err(RunError::Usage(
                "--method intent-network: imagines no minds, about which there are options".into(),
            ));
        }
        Ok(self.minds.imagined_by(Simple::bundled()?))
    }

    fn course(
        &self,
        recording: &Recording,
        simple: &Simple,
        models: &Models,
    ) -> Result<Option<Course>, RunError> {
        let failed = |error: MethodError| RunError::Method { id: recording.id.clone(), source: error };
        let observed =
            |recording: &Recording| recording.observed().map_err(|error| failed(MethodError::new(error)));
        let (event, window) = match self.cut {
            Some(cut) => {
                let clip = Clip::of(recording, cut, recording.id.clone()).map_err(|error| unfit(&error))?;
                (observed(&clip.recording)?, clip.window)
            }
            None => (observed(recording)?, Window::whole(recording.trajectory.steps())),
        };
        if window.steps == 0 {
            return Err(RunError::Usage(format!(
                "event {}: has only one row, its start; there is nothing to observe",
                recording.id
            )));
        }
        let states: Vec<State> = window.frames(recording).collect();
        let frames = regressors::motion(&recording.scene.physics(), &states)
            .map_err(|source| RunError::Render { id: recording.id.clone(), source })?;
        let Some(all_answers) = self.answers(&event, simple, models).map_err(failed)? else {
            return Ok(None);
        };
        let mut reader = models.intents.watch(&event);
        let mut rows = event.rows().iter();
        if let Some(first) = rows.next() {
            reader.push(first);
        }
        let mut chunks = Vec::with_capacity(all_answers.len());
        for (k, answers) in all_answers.into_iter().enumerate() {
            let from = k * self.every;
            let to = (from + self.every).min(window.steps);
            for row in rows.by_ref().take(to - from) {
                reader.push(row);
            }
            let part = &frames[(from * SUBSTEPS).min(frames.len())..(to * SUBSTEPS).min(frames.len())];
            chunks.push(Chunk {
                onset: seconds_of(from),
                duration: seconds_of(to - from),
                answers,
                motion: regressors::mean(part).to_vec(),
                activations: reader.activations(),
            });
        }
        let frames = frames.iter().map(|frame: &FrameMotion| frame.values().to_vec()).collect();
        Ok(Some(Course { id: recording.id.clone(), chunks, frames }))
    }

    /// The answers at the end of every chunk; `None` if a stop was requested.
    fn answers(
        &self,
        event: &ObservedEvent,
        simple: &Simple,
        models: &Models,
    ) -> Result<Option<Vec<Vec<Option<f64>>>>, MethodError> {
        let objects = event.object_sizes().len();
        let ends = (1..=event.steps().div_ceil(self.every)).map(|k| (k * self.every).min(event.steps()));
        let told = |judgement: &Judgement, prepared: Option<&PreparedEvent>| {
            [answers(judgement, objects), beliefs(prepared)].concat()
        };
        if self.method == ObservingMethod::IntentNetwork {
            let of = |end| told(&models.intents.posterior(&event.prefix(end)).judgement(), None);
            return Ok(Some(ends.map(of).collect()));
        }
        let mut observer = simple.observer(&event.prefix(0), self.seed).map_err(MethodError::new)?;
        let mut all = Vec::new();
        let mut seen = 0;
        for end in ends {
            for row in &event.rows()[seen + 1..=end] {
                observer.watch(*row).map_err(MethodError::new)?;
            }
            seen = end;
            let mut tick =
                || if interrupt::requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
            match observer.inference(&mut tick).map_err(MethodError::new)? {
                Some(inference) => all.push(told(&simple.judgement(&inference), observer.prepared())),
                None => return Ok(None),
            }
        }
        Ok(Some(all))
    }

    /// Writes the tables and returns their names.
    fn write(
        &self,
        courses: &[Course],
        presentations: Option<&[Presentation]>,
    ) -> Result<Vec<String>, RunError> {
        // Each with its onset, and the time for which it was shown (s).
        let shown: Vec<(&Course, f64, f64)> = match presentations {
            None => courses.iter().map(|course| (course, 0.0, f64::INFINITY)).collect(),
            Some(presentations) => {
                let of = |shown: &Presentation| {
                    let course = courses.iter().find(|course| shown.is_of(&course.id));
                    let unknown = || {
                        let path = self.presentations.as_deref().unwrap_or(Path::new(""));
                        unusable(
                            path,
                            &format!("stim_file {}: there is no event of that name", shown.stimulus),
                        )
                    };
                    Ok((course.ok_or_else(unknown)?, shown.onset, shown.duration.unwrap_or(f64::INFINITY)))
                };
                presentations.iter().map(of).collect::<Result<_, RunError>>()?
            }
        };
        let answers = answer_columns();
        let units =
            courses.iter().flat_map(|course| &course.chunks).map(|chunk| chunk.activations.len()).max();
        let activations: Vec<(String, String, String)> = (0..units.unwrap_or(0))
            .map(|k| {
                (
                    format!("unit{k}"),
                    String::new(),
                    "unit of the intent network's last hidden layer, mean over goals".into(),
                )
            })
            .collect();
        let motion: Vec<(String, String, String)> = MOTION
            .iter()
            .map(|(name, unit, about)| ((*name).into(), (*unit).into(), (*about).into()))
            .collect();
        let chunked = |columns: &[(String, String, String)], cells: &dyn Fn(&Chunk) -> Vec<String>| {
            let mut table = started();
            table.columns.extend_from_slice(columns);
            for (course, onset, seconds) in &shown {
                for chunk in course.chunks.iter().filter(|chunk| chunk.onset < *seconds) {
                    table.rows.push(begun(&course.id, onset + chunk.onset, chunk.duration, cells(chunk)));
                }
            }
            table
        };
        let number = |value: &f64| format!("{value:.6}");
        let numbers = |values: &[f64]| values.iter().map(number).collect::<Vec<_>>();
        let posterior = chunked(&answers, &|chunk| {
            chunk.answers.iter().map(|p| p.as_ref().map_or_else(|| MISSING.to_owned(), number)).collect()
        });
        let means = chunked(&motion, &|chunk| numbers(&chunk.motion));
        let units = chunked(&activations, &|chunk| numbers(&chunk.activations));
        let mut frames = started();
        frames.columns.extend(motion.iter().cloned());
        let frame_seconds = 1.0 / f64::from(FRAMES_PER_SECOND);
        for (course, onset, seconds) in &shown {
            let began = |k: usize| k as f64 * frame_seconds;
            for (k, values) in course.frames.iter().enumerate().take_while(|(k, _)| began(*k) < *seconds) {
                frames.rows.push(begun(&course.id, onset + began(k), frame_seconds, numbers(values)));
            }
        }
        let tables = [
            ("desc-posterior_events.tsv", posterior),
            ("desc-motion_events.tsv", means),
            ("desc-activations_events.tsv", units),
            ("desc-frames_events.tsv", frames),
        ];
        for (name, table) in &tables {
            table.write_tsv(&self.out.join(name))?;
        }
        Ok(tables.iter().map(|(name, _)| (*name).to_owned()).collect())
    }
}

/// A table with the columns that all have.
fn started() -> Table {
    let mut table = Table::default();
    let onset = "beginning of the chunk or frame, from that of the video or, with presentations, of the run";
    table.column("onset", "s", onset);
    table.column("duration", "s", "length of the chunk or frame");
    table.column("trial_type", "", "id of the event");
    table.column("stim_file", "", "video of the event");
    table
}

fn begun(id: &str, onset: f64, duration: f64, cells: Vec<String>) -> Vec<String> {
    let time = |seconds: f64| format!("{:.3}", seconds);
    [time(onset), time(duration), id.to_owned(), format!("{id}.mp4")].into_iter().chain(cells).collect()
}
