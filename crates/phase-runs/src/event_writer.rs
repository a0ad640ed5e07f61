//! Producing the files of one event: simulate it or take it from the cache, write its JSON and its video.

use crate::{
    engine::{self, GENERATOR},
    error::RunError,
    interrupt,
    listener::{Listener, Progress},
    picture::{self, Look, RenderedState},
};
use phase_dataset::event_cache::EventCache;
use phase_event::{Event, Recording};
use phase_files::{
    atomic,
    checksum::{FileEntry, hexadecimal, sha256},
    folder::Folder,
    measured, run,
};
use phase_model::{Relation, Scene};
use phase_sim::SimulationSettings;
use serde_json::{Value, json};
use std::{path::PathBuf, time::Instant};

/// Writer of events, with everything that the events of a run have in common.
pub struct EventWriter {
    settings: SimulationSettings,
    settings_value: Value,
    folder: PathBuf,
    cache: EventCache,
    progress: Box<dyn Progress>,
    look: Look,
}

/// Properties of one event that differ from the other events of its run.
#[derive(Debug)]
pub struct EventJob {
    /// Its id.
    pub id: String,
    /// Its seed.
    pub seed: u64,
    /// The relation it is to show, if that is not the scene's own.
    pub relation: Option<Relation>,
    /// Its minimum and maximum length, if they are not the run's (steps).
    pub lengths: Option<(usize, usize)>,
    /// Path of its JSON in the folder of the run, with `/`.
    pub json: String,
    /// Path of its video there, if there is to be one.
    pub video: Option<String>,
}

/// The files of one event, measured while they were written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct EventFiles {
    /// Its JSON.
    pub json: FileEntry,
    /// Its video, if there is one.
    pub video: Option<FileEntry>,
}

impl EventWriter {
    /// A production of `events` events in a folder. `activity` describes it in the progress display.
    ///
    /// # Errors
    /// [`RunError::Serialise`].
    pub fn new(
        listener: &dyn Listener,
        activity: &str,
        folder: &Folder,
        settings: SimulationSettings,
        events: usize,
    ) -> Result<Self, RunError> {
        let settings_value = settings_value(&settings)?;
        let cache = EventCache::new(&folder.cache(), fingerprint(&settings_value));
        let progress = listener.progress(activity, events, settings.max_steps);
        let look = Look::default();
        Ok(Self { settings, settings_value, folder: folder.path().to_owned(), cache, progress, look })
    }

    /// This writer with another look of its videos.
    #[must_use]
    pub fn with_look(self, look: Look) -> Self {
        Self { look, ..self }
    }

    /// Produces one event and its files; `None` if it was interrupted. The scene is requested only if the
    /// event is not in the cache.
    ///
    /// # Errors
    /// Any of [`RunError`]'s failures.
    pub fn make(
        &self,
        job: &EventJob,
        scene: impl FnOnce() -> Result<Scene, RunError>,
    ) -> Result<Option<(Event, EventFiles)>, RunError> {
        let id = &job.id;
        let begun = Instant::now();
        let mut steps = 0;
        let cached = self.cache.load(id, job.seed);
        let fresh = cached.is_none();
        let event = match cached {
            Some(event) => event,
            None => {
                let mut on_step = |_: &_| {
                    steps += 1;
                    self.progress.steps(1);
                    interrupt::goes_on()
                };
                let simulated = engine::simulate(id, &scene()?, job.seed, &self.settings, &mut on_step)?;
                let Some(event) = simulated else { return Ok(None) };
                // A video of an earlier build must not outlive the event it showed, even if the run is
                // interrupted.
                if let Some(video) = &job.video {
                    atomic::remove(&self.folder.join(video))?;
                }
                self.cache.store(id, &event)?;
                event
            }
        };
        let files = self.write(job, &event, fresh)?;
        let kind = event.scene.kind.name();
        let length = event.steps.len();
        let how = if fresh { format!("{:.1} s", begun.elapsed().as_secs_f64()) } else { "kept".into() };
        self.finished(steps, &format!("{id} {kind}: {length} steps ({how})"));
        Ok(Some((event, files)))
    }

    /// Writes the files of an event; its video if the event is new or the video is missing.
    ///
    /// # Errors
    /// If drawing or writing fails.
    pub fn write(&self, job: &EventJob, event: &Event, fresh: bool) -> Result<EventFiles, RunError> {
        let json = measured::write(&self.folder, &job.json, self.json(job, event)?.as_bytes())?;
        let video = match &job.video {
            Some(path) if fresh || !self.folder.join(path).exists() => {
                Some(measured::write(&self.folder, path, &video(&job.id, event, &self.look)?)?)
            }
            Some(path) => Some(FileEntry::of(&self.folder, path).map_err(RunError::ReadBack)?),
            None => None,
        };
        Ok(EventFiles { json, video })
    }

    /// An event is done; see [`Progress::event`].
    pub fn finished(&self, counted: usize, line: &str) {
        self.progress.event(counted, line);
    }

    /// A scene was tried in vain; see [`Progress::tried`].
    pub fn tried(&self) {
        self.progress.tried();
    }

    fn json(&self, job: &EventJob, event: &Event) -> Result<String, RunError> {
        let generator = GENERATOR.into();
        let mut settings = self.settings_value.clone();
        if let Some((min, max)) = job.lengths {
            (settings["min_steps"], settings["max_steps"]) = (min.into(), max.into());
        }
        let mut recording = Recording::of_event(job.id.clone(), event.clone(), generator, settings);
        if let Some(relation) = job.relation {
            recording.relation = relation;
        }
        Ok(phase_event::to_json(&[recording])?)
    }
}

/// Settings as stored in files.
///
/// # Errors
/// [`RunError::Serialise`].
pub fn settings_value(settings: &SimulationSettings) -> Result<Value, RunError> {
    serde_json::to_value(settings).map_err(|source| RunError::Serialise { what: "settings", source })
}

/// Draws the video of a simulated event in memory.
///
/// # Errors
/// As [`picture::video`].
pub fn video(id: &str, event: &Event, look: &Look) -> Result<Vec<u8>, RunError> {
    let items = event.frames().map(|&state| RenderedState { state, minds: Vec::new(), observer: None });
    // Events that are generated are short: a video takes a second.
    let video = picture::video(id, &event.scene.physics(), look, items, &|| false)?;
    Ok(video.unwrap_or_default())
}

/// Digest of everything that determines an event besides its scene and seed: the settings and this
/// executable. An event cached by another build is simulated again, so that no dataset mixes two.
fn fingerprint(settings: &Value) -> [u8; 32] {
    sha256(run::canonical(&json!({ "program": hexadecimal(&program()), "settings": settings })).as_bytes())
}

/// Digest of this executable.
#[must_use]
pub fn program() -> [u8; 32] {
    let program = std::env::current_exe().and_then(std::fs::read).map(|bytes| sha256(&bytes));
    program.unwrap_or_else(|_| sha256(GENERATOR.as_bytes()))
}
