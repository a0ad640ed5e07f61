//! Every way in which a test of promises about files can fail, and its exit code.

use phase_cli::{error::CliError, program::Failure};
use phase_runs::error::RunError;
use std::io;
use thiserror::Error;

/// Reason that a command of this program failed. The text is one plain sentence.
#[derive(Debug, Error)]
pub enum TortureError {
    /// A command of `phase` failed, or code that is shared with them.
    #[error(transparent)]
    Cli(#[from] CliError),
    /// A run on many events failed.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The program that is to be disturbed cannot be started.
    #[error("the program cannot be started: {0}")]
    Start(#[source] io::Error),
    /// A command that nothing disturbs does not do what it should.
    #[error("{what}: {problem}")]
    Undisturbed {
        /// The command.
        what: &'static str,
        /// The problem, in words.
        problem: String,
    },
    /// The user interrupted a command that keeps nothing of what it has done.
    #[error("interrupted; nothing is written")]
    Interrupted,
    /// Commands that were stopped or disturbed lost something.
    #[error("{0} time(s) something was lost, half-written or different; see above")]
    Tortured(usize),
}

impl Failure for TortureError {
    fn exit_code(&self) -> u8 {
        match self {
            Self::Cli(error) => error.exit_code(),
            Self::Run(error) => error.exit_code(),
            Self::Interrupted => 130,
            Self::Start(_) | Self::Undisturbed { .. } | Self::Tortured(_) => 1,
        }
    }
}
