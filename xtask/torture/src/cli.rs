//! The commands that test promises about files, and those that they test.

use crate::{
    check_verify::{self, CheckVerify},
    error::TortureError,
    torture::{self, Torture},
};
use clap::{Parser, Subcommand};
use phase_cli::{
    context::{Context, Verbosity},
    program::Interface,
};

/// Tests of promises about files
#[derive(Parser, Debug)]
#[command(version)]
pub struct Cli {
    /// The command.
    #[command(subcommand)]
    pub command: Command,
    /// Verbosity.
    #[command(flatten)]
    pub verbosity: Verbosity,
}

/// A command that tests, or one that is tested.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// A command of `phase`, which this program starts to disturb it.
    #[command(flatten)]
    Phase(Box<phase_cli::cli::Command>),
    /// Edit a dataset many times, and count what verify finds
    CheckVerify(CheckVerify),
    /// Stop commands while they write, and check that nothing is lost
    Torture(Torture),
}

impl Interface for Cli {
    type Error = TortureError;

    fn verbosity(&self) -> Verbosity {
        self.verbosity
    }

    fn run(&self, context: &Context) -> Result<(), TortureError> {
        match &self.command {
            Command::Phase(command) => Ok(command.run(context)?),
            Command::CheckVerify(arguments) => check_verify::run(arguments, context),
            Command::Torture(arguments) => torture::run(arguments, context),
        }
    }
}
