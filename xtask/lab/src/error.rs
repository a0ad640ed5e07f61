//! Every way in which a command of the lab can fail, and its exit code.

use phase_calibration::ReadError;
use phase_cli::{error::CliError, program::Failure};
use phase_runs::error::RunError;
use std::path::PathBuf;
use thiserror::Error;

/// Reason that a command of the lab failed. The text is one plain sentence.
#[derive(Debug, Error)]
pub enum LabError {
    /// Code that the lab shares with the commands of `phase` failed.
    #[error(transparent)]
    Cli(#[from] CliError),
    /// A run on many events failed.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A file of probes or runs cannot be used.
    #[error("{}: {source}", file.display())]
    Calibration {
        /// The file.
        file: PathBuf,
        /// The problem with it.
        source: ReadError,
    },
    /// The bundled intent network cannot be read.
    #[error("the bundled intent network: {0}")]
    IntentNetwork(#[from] phase_simple::intent_network::IntentNetworkError),
    /// There is no place for a video that is looked at only once.
    #[error("no temporary folder can be made: {0}")]
    Scratch(#[source] std::io::Error),
    /// The user interrupted a command that keeps nothing of what it has done.
    #[error("interrupted; nothing is written")]
    Interrupted,
}

impl Failure for LabError {
    fn exit_code(&self) -> u8 {
        match self {
            Self::Cli(error) => error.exit_code(),
            Self::Run(error) => error.exit_code(),
            Self::Calibration { .. } => 2,
            Self::Interrupted => 130,
            Self::IntentNetwork(_) | Self::Scratch(_) => 1,
        }
    }
}
