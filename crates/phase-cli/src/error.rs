//! Every way in which a command can fail, and its exit code.

use crate::program::Failure;
#[cfg(feature = "networks")]
use crate::train::error::TrainError;
use phase_dataset::{FileError, WriteError, folder::FolderError, parquet::ExportError};
use phase_eval::MethodError;
use phase_event::EventWriteError;
use phase_render::RenderError;
use phase_sampler::{SampleError, Variant};
use phase_sim::SimulationError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a command failed. The text is one plain sentence.
#[derive(Debug, Error)]
pub enum CliError {
    /// An input file cannot be used.
    #[error(transparent)]
    File(#[from] FileError),
    /// The output folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// The output cannot be written where it was asked for.
    #[error(transparent)]
    Output(WriteError),
    /// The folder belongs to a run with other options.
    #[error("{}: holds {state} run of another kind ({difference}); choose another folder or remove it", path.display())]
    OtherRun {
        /// The folder.
        path: PathBuf,
        /// `an unfinished` or `a finished`.
        state: &'static str,
        /// How that run differs from this one.
        difference: String,
    },
    /// A finished folder is no longer what was written into it.
    #[error("{0}; remove the folder or choose another")]
    Altered(FileError),
    /// There is no preset of this name.
    #[error("--preset: there is no preset {name:?}; there is {known}")]
    UnknownPreset {
        /// The name given.
        name: String,
        /// The names there are.
        known: String,
    },
    /// The file has no event of this id.
    #[error("{}: has no event {id:?}{near}", file.display())]
    UnknownId {
        /// The file.
        file: PathBuf,
        /// The id given.
        id: String,
        /// Ids that look like it, in words.
        near: String,
    },
    /// A folder holds nothing to render.
    #[error("{}: is a folder without manifest.json or summary.json; give an event file or a finished dataset", .0.display())]
    NotADataset(PathBuf),
    /// An option does not go with the input.
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
    #[error("event {id}: no scene ({}) showed its label ({reasons}); the preset's selection.attempts is the limit", variant.name())]
    Exhausted {
        /// The event.
        id: String,
        /// What was tried.
        variant: Variant,
        /// Why the scenes were refused, with numbers.
        reasons: String,
    },
    /// Writing broke off, with the disk full for example.
    #[error("{0}; what is finished is kept, and the same command goes on from there")]
    Write(#[from] WriteError),
    /// A file written a moment ago cannot be read back.
    #[error("{0}; what is finished is kept, and the same command goes on from there")]
    ReadBack(FileError),
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
    #[error("cannot start {jobs} threads: {reason}")]
    Threads {
        /// How many.
        jobs: usize,
        /// Why.
        reason: String,
    },
    /// A dataset is not what its manifest says; the problems have been told.
    #[error("{}: {problems} problem(s)", folder.display())]
    NotWhole {
        /// The dataset.
        folder: PathBuf,
        /// How many.
        problems: usize,
    },
    /// A dataset has no manifest because its run was broken off.
    #[error("{}: is unfinished; the command that began it goes on from there", .0.display())]
    Unfinished(PathBuf),
    /// A split breaks rules.
    #[error("{}: its split breaks {broken} rule(s)", events.display())]
    RulesBroken {
        /// The dataset.
        events: PathBuf,
        /// How many.
        broken: usize,
    },
    /// A training failed.
    #[cfg(feature = "networks")]
    #[error(transparent)]
    Train(#[from] TrainError),
    /// A neural network was asked for in a program that has none.
    #[error("neural networks are needed, which this program was built without; {hint}")]
    NoNetworks {
        /// What to do instead.
        hint: &'static str,
    },
    /// The user broke off.
    #[error("interrupted; what is finished is kept in {}, and the same command goes on from there", .0.display())]
    Interrupted(PathBuf),
}

impl From<ExportError> for CliError {
    fn from(error: ExportError) -> Self {
        match error {
            ExportError::Read(error) => Self::ReadBack(error),
            ExportError::Write(error) => Self::Write(error),
        }
    }
}

impl Failure for CliError {
    fn exit_code(&self) -> u8 {
        match self {
            Self::File(_)
            | Self::Folder(_)
            | Self::Output(_)
            | Self::OtherRun { .. }
            | Self::Altered(_)
            | Self::UnknownPreset { .. }
            | Self::UnknownId { .. }
            | Self::NotADataset(_)
            | Self::NotWhole { .. }
            | Self::Unfinished(_)
            | Self::RulesBroken { .. }
            | Self::NoNetworks { .. }
            | Self::Usage(_) => 2,
            Self::Interrupted(_) => 130,
            Self::Simulation { .. }
            | Self::Method { .. }
            | Self::Sample(_)
            | Self::Exhausted { .. }
            | Self::Write(_)
            | Self::ReadBack(_)
            | Self::EventWrite(_)
            | Self::Render { .. }
            | Self::Threads { .. } => 1,
            #[cfg(feature = "networks")]
            Self::Train(error) => error.exit_code(),
        }
    }
}

impl CliError {
    /// An id that a file does not have, with those that come nearest to it.
    #[must_use]
    pub fn unknown_id<'a>(file: &Path, id: &str, ids: impl Iterator<Item = &'a str>) -> Self {
        const SHOWN: usize = 5;
        let mut ids: Vec<&str> = ids.collect();
        ids.sort_by_key(|known| (edit_distance(id, known), *known));
        let count = ids.len();
        ids.truncate(SHOWN);
        let near = match count {
            0 => String::new(),
            1..=SHOWN => format!("; it has {}", ids.join(", ")),
            _ => format!("; nearest of its {count} are {}", ids.join(", ")),
        };
        Self::UnknownId { file: file.to_owned(), id: id.into(), near }
    }
}

/// Fewest letters to insert, remove or replace to get from one text to the other.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, letter) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, &other) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(letter != other);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}
