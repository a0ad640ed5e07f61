//! Every way in which a chore can fail, and its exit code.

use phase_calibration::ReadError;
use phase_cli::{error::CliError, program::Failure};
use std::path::PathBuf;
use thiserror::Error;

/// Why a command of `cargo xtask` failed. The text is one plain sentence.
#[derive(Debug, Error)]
pub enum XtaskError {
    /// A command of `phase` failed, or what chores have in common with them.
    #[error(transparent)]
    Cli(#[from] CliError),
    /// A file of probes or runs cannot be used.
    #[error("{}: {source}", file.display())]
    Record {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        source: ReadError,
    },
    /// Tidy found something.
    #[error("{0} rule(s) broken")]
    Untidy(usize),
}

impl Failure for XtaskError {
    fn exit_code(&self) -> u8 {
        match self {
            Self::Cli(error) => error.exit_code(),
            Self::Record { .. } => 2,
            Self::Untidy(_) => 1,
        }
    }
}
