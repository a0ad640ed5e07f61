//! Every way in which a chore can fail, and its exit code.

use phase_cli::{error::CliError, program::Failure};
use std::{
    io,
    path::{Path, PathBuf},
};
use thiserror::Error;

/// Reason that a command of `cargo xtask` failed. The text is one plain sentence.
#[derive(Debug, Error)]
pub enum XtaskError {
    /// A command of `phase` failed, or code that chores share with them.
    #[error(transparent)]
    Cli(#[from] CliError),
    /// A file or folder of the workspace cannot be read.
    #[error("{}: cannot be read: {source}", file.display())]
    Unreadable {
        /// The file or folder.
        file: PathBuf,
        /// Reason that the system gives.
        source: io::Error,
    },
    /// Cargo cannot be started.
    #[error("cargo cannot be started: {0}")]
    Cargo(#[source] io::Error),
    /// Something that has to be built is not.
    #[error("{what}: {problem}")]
    Build {
        /// The thing that was being built, or the tool that builds it.
        what: &'static str,
        /// The problem, in words.
        problem: String,
    },
    /// Documents do not have the figures of `data/results.json`.
    #[error("{0} document(s) differ from what `cargo xtask results` writes")]
    Results(usize),
    /// Tidy found something.
    #[error("{0} rule(s) broken")]
    Untidy(usize),
}

impl XtaskError {
    /// The error of reading this file or folder.
    pub(crate) fn unreadable(file: &Path) -> impl FnOnce(io::Error) -> Self + use<> {
        let file = file.to_owned();
        |source| Self::Unreadable { file, source }
    }
}

impl Failure for XtaskError {
    fn exit_code(&self) -> u8 {
        if let Self::Cli(error) = self { error.exit_code() } else { 1 }
    }
}
