//! Every way in which a development command can fail, and its exit code.

use crate::draw_behaviour::DrawError;
use phase_calibration::ReadError;
use phase_cli::{error::CliError, program::Failure};
use std::{io, path::PathBuf};
use thiserror::Error;

/// Why a command of `cargo xtask` failed. The text is one plain sentence.
#[derive(Debug, Error)]
pub enum XtaskError {
    /// A command of `phase` failed, or code that development commands share with them.
    #[error(transparent)]
    Cli(#[from] CliError),
    /// A file of probes or runs cannot be used.
    #[error("{}: {source}", file.display())]
    Calibration {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        source: ReadError,
    },
    /// A file or folder of the workspace cannot be read.
    #[error("{}: cannot be read: {source}", file.display())]
    Unreadable {
        /// The file or folder.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The bundled intent network cannot be read.
    #[error("the bundled intent network: {0}")]
    IntentNetwork(#[from] phase_simple::intent_network::IntentNetworkError),
    /// A scene cannot be drawn.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// Cargo cannot be started.
    #[error("cargo cannot be started: {0}")]
    Cargo(#[source] io::Error),
    /// Something that has to be built is not.
    #[error("{what}: {problem}")]
    Build {
        /// What was being built, or the tool that builds it.
        what: &'static str,
        /// What went wrong.
        problem: String,
    },
    /// A golden test failed; it has reported the differences.
    #[error("golden values differ from what is computed, or their tests cannot be built; see above")]
    GoldenTests,
    /// The user interrupted a command that keeps nothing of what it has done.
    #[error("interrupted; nothing is written")]
    Interrupted,
    /// Documents do not have the figures of `docs/results.json`.
    #[error("{0} document(s) differ from what `cargo xtask results` writes")]
    Results(usize),
    /// A target of fuzzing panicked on an input.
    #[error("the target {target} failed: {message}; {}", match file {
        Some(file) => format!("its input is {}", file.display()),
        None => "its input could not be written".into(),
    })]
    Fuzz {
        /// The target.
        target: String,
        /// What the panic said.
        message: String,
        /// Where the input is kept.
        file: Option<PathBuf>,
    },
    /// Commands that were stopped or disturbed lost something.
    #[error("{0} time(s) something was lost, half-written or different; see above")]
    Tortured(usize),
    /// Tidy found something.
    #[error("{0} rule(s) broken")]
    Untidy(usize),
}

impl Failure for XtaskError {
    fn exit_code(&self) -> u8 {
        match self {
            Self::Cli(error) => error.exit_code(),
            Self::Calibration { .. } => 2,
            Self::Interrupted => 130,
            Self::Unreadable { .. }
            | Self::Draw(_)
            | Self::IntentNetwork(_)
            | Self::Cargo(_)
            | Self::Build { .. }
            | Self::GoldenTests
            | Self::Results(_)
            | Self::Fuzz { .. }
            | Self::Tortured(_)
            | Self::Untidy(_) => 1,
        }
    }
}
