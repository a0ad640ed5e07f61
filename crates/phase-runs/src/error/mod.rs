//! Every way in which a run can fail.

#[cfg(feature = "networks")]
pub mod train;
pub mod video;

#[cfg(feature = "networks")]
use phase_baselines::training::{NetworkError, TrainingRecordError};
use phase_dataset::ExportError;
use phase_event::{EventWriteError, MethodError};
use phase_files::{FileError, WriteError, folder::FolderError};
use phase_model::json::{FieldError, edit_distance};
use phase_render::RenderError;
use phase_sampler::SampleError;
use phase_sim::SimulationError;
use phase_simple::{ModelsError, intent_network::IntentNetworkError};
use rayon::ThreadPoolBuildError;
use std::path::{Path, PathBuf};
use thiserror::Error;
#[cfg(feature = "networks")]
use train::TrainError;
use video::VideoError;

/// Why a run failed. The text is one plain sentence that names the file or the event.
#[derive(Debug, Error)]
pub enum RunError {
    /// An input file cannot be used.
    #[error(transparent)]
    File(#[from] FileError),
    /// The output folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// The output cannot be written to the given path.
    #[error(transparent)]
    Output(WriteError),
    /// The files of a finished folder have changed.
    #[error("{0}; remove the folder or choose another")]
    Altered(#[source] FileError),
    /// There is no preset of this name.
    #[error("--preset: unknown preset {name:?}; available: {known}")]
    UnknownPreset {
        /// The name given.
        name: String,
        /// The available names.
        known: String,
    },
    /// The file has no event of this id.
    #[error("{}: has no event {id:?}{near}", file.display())]
    UnknownId {
        /// The file.
        file: PathBuf,
        /// The id given.
        id: String,
        /// Similar ids, in words.
        near: String,
    },
    /// The file of predictions has no answers to some of the events.
    #[error("{}: has no answer to {missing} of the {of} events of {events}: {which}{near}", file.display())]
    NoAnswers {
        /// The file.
        file: PathBuf,
        /// Number of events without an answer.
        missing: usize,
        /// Number of events.
        of: usize,
        /// The events, in words.
        events: String,
        /// Ids of the first of those without an answer.
        which: String,
        /// Ids of the file similar to the first of them, in words.
        near: String,
    },
    /// A folder holds no events.
    #[error("{}: is a folder without manifest.json or summary.json, and without event files; give one of them", .0.display())]
    NotADataset(PathBuf),
    /// A field of the run is not compatible with the input.
    #[error("{0}")]
    Usage(String),
    /// A scene cannot be simulated.
    #[error("event {id}: {source}")]
    Simulation {
        /// The event.
        id: String,
        /// Why.
        source: SimulationError,
    },
    /// A method of perception has no answer.
    #[error("event {id}: {source}")]
    Method {
        /// The event.
        id: String,
        /// Why.
        source: MethodError,
    },
    /// No scene could be drawn.
    #[error(transparent)]
    Sample(#[from] SampleError),
    /// No scene of a slot showed its label.
    #[error("{id}: no scene was accepted within selection.attempts of the preset ({reasons})")]
    Exhausted {
        /// The event or set.
        id: String,
        /// Why the scenes were rejected, with numbers.
        reasons: String,
    },
    /// Writing failed, for example because the disk is full.
    #[error("{failure}; {after}", failure = .0, after = kept(&.0.path))]
    Write(#[from] WriteError),
    /// A file that was just written cannot be read back.
    #[error("{failure}; {after}", failure = .0, after = kept(&.0.file))]
    ReadBack(#[source] FileError),
    /// An event cannot be written.
    #[error(transparent)]
    EventWrite(#[from] EventWriteError),
    /// A picture or video could not be made.
    #[error("event {id}: {source}")]
    Render {
        /// The event.
        id: String,
        /// Why.
        source: RenderError,
    },
    /// The threads could not be started.
    #[error("cannot start {jobs} threads: {source}")]
    Threads {
        /// Number of threads.
        jobs: usize,
        /// Why.
        source: ThreadPoolBuildError,
    },
    /// A value cannot be converted to JSON.
    #[error("{what} cannot be written as JSON: {source}")]
    Serialise {
        /// Name of the value.
        what: &'static str,
        /// Why.
        source: serde_json::Error,
    },
    /// The settings that an event was made with cannot be used.
    #[error("{}: event {id}: {source}", file.display())]
    SimulationSettings {
        /// The file.
        file: PathBuf,
        /// The event.
        id: String,
        /// Why.
        source: FieldError,
    },
    /// An event is too short for the requested operation.
    #[error("{}: event {id} has only one row, its start; {needed}", file.display())]
    StartAlone {
        /// The file.
        file: PathBuf,
        /// The event.
        id: String,
        /// The operation that requires more rows.
        needed: &'static str,
    },
    /// A video or table has no motion that can be read.
    #[error("{}: {source}", file.display())]
    Track {
        /// The file.
        file: PathBuf,
        /// Why.
        source: VideoError,
    },
    /// A dataset has no manifest because its run was interrupted.
    #[error("{}: is unfinished; the command that began it goes on from there", .0.display())]
    Unfinished(PathBuf),
    /// A training failed.
    #[cfg(feature = "networks")]
    #[error(transparent)]
    Train(#[from] TrainError),
    /// The models that come with the program cannot be used.
    #[error("the program was built with a damaged file")]
    Models(#[from] ModelsError),
    /// A file of weights of the intent network cannot be used.
    #[error("{}: is not a complete file of weights: {source}", file.display())]
    IntentNetwork {
        /// The file.
        file: PathBuf,
        /// Why.
        source: IntentNetworkError,
    },
    /// A file of weights cannot be used.
    #[cfg(feature = "networks")]
    #[error("{}: is not a complete file of weights: {source}", file.display())]
    Weights {
        /// The file.
        file: PathBuf,
        /// Why.
        source: NetworkError,
    },
    /// The record of a training cannot be used.
    #[cfg(feature = "networks")]
    #[error("{}: {source}", file.display())]
    TrainingRecord {
        /// The file.
        file: PathBuf,
        /// Why.
        source: TrainingRecordError,
    },
    /// A stop was requested, see [`crate::interrupt`].
    #[error("interrupted; what is finished is kept in {}, and the same command goes on from there", .0.display())]
    Interrupted(PathBuf),
    /// A stop of a run that begins again from nothing was requested.
    #[error("interrupted; {}", .0.as_ref().map_or_else(
        || "the same command begins again".to_owned(),
        |file| format!("{} contains what was finished before", file.display()),
    ))]
    Stopped(Option<PathBuf>),
}

/// Thing that has to change for a run to succeed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fault {
    /// The input, the options or the output folder.
    Input,
    /// The machine or this program, such as a full disk or a scene that cannot be simulated.
    Run,
    /// Nothing: somebody stopped it.
    Interruption,
}

impl RunError {
    /// Thing that has to change for the run to succeed.
    #[must_use]
    pub fn fault(&self) -> Fault {
        match self {
            Self::Output(error) | Self::Folder(FolderError::NotWritable(error)) if error.is_full() => {
                Fault::Run
            }
            Self::Track { source: VideoError::Interrupted, .. } | Self::Interrupted(_) | Self::Stopped(_) => {
                Fault::Interruption
            }
            Self::File(_)
            | Self::Folder(_)
            | Self::Output(_)
            | Self::Altered(_)
            | Self::UnknownPreset { .. }
            | Self::UnknownId { .. }
            | Self::NoAnswers { .. }
            | Self::NotADataset(_)
            | Self::IntentNetwork { .. }
            | Self::Unfinished(_)
            | Self::SimulationSettings { .. }
            | Self::StartAlone { .. }
            | Self::Track { .. }
            | Self::Usage(_) => Fault::Input,
            Self::Simulation { source: SimulationError::Awareness(_), .. } => Fault::Input,
            Self::Simulation { .. }
            | Self::Method { .. }
            | Self::Models(_)
            | Self::Sample(_)
            | Self::Exhausted { .. }
            | Self::Write(_)
            | Self::ReadBack(_)
            | Self::EventWrite(_)
            | Self::Render { .. }
            | Self::Serialise { .. }
            | Self::Threads { .. } => Fault::Run,
            #[cfg(feature = "networks")]
            Self::Weights { .. } | Self::TrainingRecord { .. } => Fault::Input,
            #[cfg(feature = "networks")]
            Self::Train(error) => error.fault(),
        }
    }

    /// An id that a file does not contain, with the most similar ones.
    #[must_use]
    pub(crate) fn unknown_id<'a>(file: &Path, id: &str, ids: impl Iterator<Item = &'a str>) -> Self {
        Self::UnknownId { file: file.to_owned(), id: id.into(), near: near(id, ids.collect()) }
    }

    /// Predictions without answers to some of the events, of which there is at least one.
    pub(crate) fn no_answers<'a>(
        file: &Path,
        missing: &[&str],
        of: usize,
        events: &str,
        ids: impl Iterator<Item = &'a str>,
    ) -> Self {
        let others = if missing.len() > IDS_SHOWN { " …" } else { "" };
        let first: Vec<&str> = missing.iter().copied().take(IDS_SHOWN).collect();
        Self::NoAnswers {
            file: file.to_owned(),
            missing: missing.len(),
            of,
            events: events.into(),
            which: format!("{}{others}", first.join(", ")),
            near: near(first.first().copied().unwrap_or_default(), ids.collect()),
        }
    }
}

/// Greatest number of ids that a message names.
const IDS_SHOWN: usize = 5;

/// The ids most similar to one, as the end of a sentence.
fn near(id: &str, mut ids: Vec<&str>) -> String {
    ids.sort_by_key(|known| (edit_distance(id, known), *known));
    let count = ids.len();
    ids.truncate(IDS_SHOWN);
    match count {
        0 => String::new(),
        1..=IDS_SHOWN => format!("; it has {}", ids.join(", ")),
        _ => format!("; nearest of its {count} are {}", ids.join(", ")),
    }
}

/// Says what has become of a run that could not write or read one of its files.
fn kept(path: &Path) -> &'static str {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    if folder.is_none_or(Path::exists) {
        "the same command goes on from what is finished there"
    } else {
        "its folder is no longer there, nor is what was finished in it; the same command makes it again"
    }
}

impl From<ExportError> for RunError {
    fn from(error: ExportError) -> Self {
        match error {
            ExportError::Read(error) => Self::ReadBack(error),
            ExportError::Write(error) => Self::Write(error),
        }
    }
}
