//! Every way in which a command can fail, and its exit code.

use crate::{console::Unprinted, program::Failure};
#[cfg(feature = "serve")]
use phase_files::folder::FolderError;
use phase_files::{FileError, WriteError};
use phase_model::EventKind;
use phase_runs::error::{Fault, RunError};
use phase_sampler::SampleError;
use std::path::PathBuf;
use thiserror::Error;

/// Words with which [`CliError::NotBuilt`] begins, for programs that start this one.
pub const BUILT_WITHOUT: &str = "this program was built without";

/// Why a command failed. The text is one plain sentence.
#[derive(Debug, Error)]
pub enum CliError {
    /// A run on many events failed.
    #[error(transparent)]
    Run(#[from] RunError),
    /// An input file cannot be used.
    #[error(transparent)]
    File(#[from] FileError),
    /// The output cannot be written to the given path.
    #[error(transparent)]
    Output(WriteError),
    /// The result cannot be written to stdout.
    #[error(transparent)]
    Stdout(#[from] Unprinted),
    /// An option is not compatible with the input.
    #[error("{0}")]
    Usage(String),
    /// No scene could be drawn.
    #[error(transparent)]
    Sample(#[from] SampleError),
    /// A value cannot be converted to JSON.
    #[error("{what} cannot be written as JSON: {source}")]
    Serialise {
        /// Name of the value.
        what: &'static str,
        /// Why.
        source: serde_json::Error,
    },
    /// No initial scene could be drawn.
    #[error("--layout {layout}: no {} scene fits this layout; choose another", kind.name())]
    NoScene {
        /// The layout's number.
        layout: u8,
        /// The kind of event.
        kind: EventKind,
        /// Why all of its variants failed.
        source: SampleError,
    },
    /// A dataset disagrees with its manifest; the problems have been reported.
    #[error("{}: {problems} problem(s)", folder.display())]
    NotWhole {
        /// The dataset.
        folder: PathBuf,
        /// Number of problems.
        problems: usize,
    },
    /// Some of several inputs cannot be tracked; the others are written.
    #[error("{} of {inputs} inputs were refused:{}", refused.len(), list(refused))]
    Refused {
        /// Number of inputs.
        inputs: usize,
        /// Why, for each that was refused.
        refused: Vec<RunError>,
    },
    /// A split breaks rules.
    #[error("{}: its split breaks {broken} rule(s)", events.display())]
    RulesBroken {
        /// The dataset.
        events: PathBuf,
        /// Number of broken rules.
        broken: usize,
    },
    /// The command needs a part of the program that it was built without.
    #[error("{} {part}; {hint}", BUILT_WITHOUT)]
    NotBuilt {
        /// The missing part, as the end of a sentence.
        part: &'static str,
        /// Advice on what to do instead.
        hint: &'static str,
    },
    /// The configuration of a study cannot be used.
    #[cfg(feature = "serve")]
    #[error("{}: {source}", file.display())]
    Study {
        /// The file.
        file: PathBuf,
        /// Why.
        source: Box<phase_study::config::ConfigError>,
    },
    /// The answers of a study cannot be read.
    #[cfg(feature = "serve")]
    #[error(transparent)]
    Answers(phase_study::store::StoreError),
    /// The forms that come with the program cannot be used.
    #[cfg(feature = "serve")]
    #[error(transparent)]
    Forms(phase_study::forms::FormsError),
    /// The server cannot start or had to stop.
    #[cfg(feature = "serve")]
    #[error(transparent)]
    Serve(#[from] phase_serve::ServeError),
}

/// Errors, each in a line of its own.
fn list(errors: &[RunError]) -> String {
    errors.iter().map(|error| format!("\n  {error}")).collect()
}

impl Failure for CliError {
    fn exit_code(&self) -> u8 {
        match self {
            Self::Run(error) => error.exit_code(),
            Self::Output(error) if error.is_full() => 1,
            Self::File(_)
            | Self::Output(_)
            | Self::NotWhole { .. }
            | Self::RulesBroken { .. }
            | Self::Refused { .. }
            | Self::NotBuilt { .. }
            | Self::NoScene { .. }
            | Self::Usage(_) => 2,
            Self::Sample(_) | Self::Serialise { .. } | Self::Stdout(_) => 1,
            #[cfg(feature = "serve")]
            Self::Serve(error) => match error {
                phase_serve::ServeError::Random(_) | phase_serve::ServeError::Runtime(_) => 1,
                phase_serve::ServeError::Answers(error) if error.is_full() => 1,
                phase_serve::ServeError::Write(error) if error.is_full() => 1,
                phase_serve::ServeError::Folder(FolderError::NotWritable(error)) if error.is_full() => 1,
                _ => 2,
            },
            #[cfg(feature = "serve")]
            Self::Answers(error) if error.is_full() => 1,
            #[cfg(feature = "serve")]
            Self::Study { .. } | Self::Answers(_) => 2,
            #[cfg(feature = "serve")]
            Self::Forms(_) => 1,
        }
    }
}

impl Failure for RunError {
    fn exit_code(&self) -> u8 {
        match self.fault() {
            Fault::Input => 2,
            Fault::Run => 1,
            Fault::Interruption => 130,
        }
    }
}
