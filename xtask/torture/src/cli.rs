//! The commands that test promises about files, and those that they test.

use crate::{
    check_verify::{self, CheckVerify},
    error::TortureError,
    torture::{self, Torture},
};
use clap::Subcommand;
use phase_cli::{
    context::Context,
    program::{CommandLine, Interface},
};

/// The command line.
pub type Cli = CommandLine<Command>;

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

impl Interface for Command {
    type Error = TortureError;

    const ABOUT: &'static str = "Tests of promises about files";

    fn run(&self, context: &Context) -> Result<(), TortureError> {
        match self {
            Self::Phase(command) => Ok(command.run(context)?),
            Self::CheckVerify(arguments) => check_verify::run(arguments, context),
            Self::Torture(arguments) => torture::run(arguments, context),
        }
    }
}
