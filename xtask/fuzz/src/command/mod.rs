//! The commands of `cargo xtask` that fuzz.

mod check_engines;
mod fuzz;

use check_engines::CheckEngines;
use clap::Subcommand;
use fuzz::Fuzz;
use phase_cli::{
    context::Context,
    error::CliError,
    program::{self, CommandLine, Interface},
};
use std::{io, path::PathBuf};
use thiserror::Error;

/// The command line.
pub type Cli = CommandLine<Command>;

/// A command that fuzzes.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Look for energy from nowhere, overlaps and other oddities of both engines in random scenes
    CheckEngines(CheckEngines),
    /// Run readers, engines, planner and searches on mutated inputs
    Fuzz(Fuzz),
}

/// Reason that a command that fuzzes failed. The text is one plain sentence.
#[derive(Debug, Error)]
pub enum FuzzError {
    /// Something shared with `phase` failed.
    #[error(transparent)]
    Cli(#[from] CliError),
    /// The folder of a target's inputs cannot be read.
    #[error("{}: cannot be read: {source}", folder.display())]
    Unreadable {
        /// The folder.
        folder: PathBuf,
        /// Reason that the system gives.
        source: io::Error,
    },
    /// A target panicked on an input.
    #[error("the target {target} failed: {message}; {}", match file {
        Some(file) => format!("its input is {}", file.display()),
        None => "its input could not be written".into(),
    })]
    Failed {
        /// The target.
        target: String,
        /// Message of the panic.
        message: String,
        /// The file that has the input, if it could be written.
        file: Option<PathBuf>,
    },
}

impl program::Failure for FuzzError {
    fn exit_code(&self) -> u8 {
        1
    }
}

impl Interface for Command {
    type Error = FuzzError;

    const ABOUT: &'static str = "Fuzzing, and both engines in random scenes";

    fn run(&self, context: &Context) -> Result<(), FuzzError> {
        match self {
            Self::CheckEngines(arguments) => Ok(check_engines::run(arguments, context)?),
            Self::Fuzz(arguments) => fuzz::run(arguments, context),
        }
    }
}
