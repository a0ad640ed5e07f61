//! The commands of `cargo xtask`.

use crate::{
    book::{self, Book},
    error::XtaskError,
    leaderboard::{self, Leaderboard},
    packages::Elsewhere,
    results::{self, Results},
    tidy::{self, Tidy},
    wasm,
};
use clap::Subcommand;
use phase_cli::{
    context::Context,
    playground::{self, Playground},
    program::{CommandLine, Interface},
};

/// The command line.
pub type Cli = CommandLine<Command>;

/// A command of `cargo xtask`.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// A command of `phase`.
    #[command(flatten)]
    Phase(Box<phase_cli::cli::Command>),
    /// A command of a package below `xtask/`.
    #[command(flatten)]
    Elsewhere(Elsewhere),
    /// Make the book of the documents, with mdBook
    Book(Book),
    /// Score the predictions in data/leaderboard, and rewrite its page
    Leaderboard(Leaderboard),
    /// Rewrite the documents that show results from data/results.json, which `benchmark --figures` writes
    Results(Results),
    /// Check the project rules that the compiler cannot
    Tidy(Tidy),
}

impl Interface for Command {
    type Error = XtaskError;

    const ABOUT: &'static str = "The commands of phase, and the development commands of this workspace";

    fn run(&self, context: &Context) -> Result<(), XtaskError> {
        match self {
            Self::Phase(command) => match &**command {
                // The source can build what an installed program includes.
                phase_cli::cli::Command::Playground(Playground { out, wasm: None }) => {
                    let wasm = Some(wasm::build(context)?);
                    Ok(playground::run(&Playground { out: out.clone(), wasm }, context)?)
                }
                command => Ok(command.run(context)?),
            },
            Self::Elsewhere(line) => line.run(context.verbosity),
            Self::Book(options) => book::run(options),
            Self::Leaderboard(options) => leaderboard::run(options, context),
            Self::Results(options) => results::run(options),
            Self::Tidy(options) => tidy::run(options),
        }
    }
}
