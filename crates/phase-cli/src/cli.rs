//! The commands of `phase`. The options of each stand beside what it does.

use crate::{
    benchmark::{self, options::Benchmark},
    completions::{self, Completions},
    context::{Context, Verbosity},
    error::CliError,
    eval::{self, options::Eval},
    gen_dataset::{
        self, merge,
        options::{GenDataset, Merge},
    },
    man::{self, ManPages},
    new_scene::{self, options::NewScene},
    program::Interface,
    render::{self, options::Render},
    simulate::{self, options::Simulate},
    splits::{self, Splits},
    stats::{self, Stats},
    train::{self, options::Train},
    verify::{self, Verify},
};
use clap::{Parser, Subcommand};

/// Physically grounded social events: two agents see, believe, plan and act
#[derive(Parser, Debug)]
#[command(name = "phase", version)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// How much to say.
    #[command(flatten)]
    pub verbosity: Verbosity,
}

/// What to do.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Write a scene to start from, with comments, for simulate
    NewScene(NewScene),
    /// Make a dataset of social events, with videos and a page to look at them
    GenDataset(GenDataset),
    /// Put the shards of a dataset together
    Merge(Merge),
    /// Check how a dataset is divided into train, validation and test, or divide it
    Splits(Splits),
    /// Show the figures of the paper's dataset beside those of another, and plot them
    Stats(Stats),
    /// Simulate the scenes of a phase-events/1 file, each from its first row
    Simulate(Simulate),
    /// Check that a dataset is whole: every checksum, no file too many, and that its files agree
    Verify(Verify),
    /// Turn events into videos, or into pictures of their key frames
    Render(Render),
    /// Measure how well a method perceives events: recognises goals and relations, or predicts trajectories
    #[command(subcommand)]
    Eval(Eval),
    /// Train a neural network on a dataset
    #[command(subcommand)]
    Train(Train),
    /// Measure all methods at both tasks and put them beside what is published, in one report
    Benchmark(Benchmark),
    /// Print a script with which a shell completes the commands and options of phase
    Completions(Completions),
    /// Write the manual pages of phase
    Man(ManPages),
}

impl Interface for Cli {
    type Error = CliError;

    fn verbosity(&self) -> Verbosity {
        self.verbosity
    }

    fn run(&self, context: &Context) -> Result<(), CliError> {
        self.command.run(context)
    }
}

impl Command {
    /// Runs the command.
    ///
    /// # Errors
    /// Any [`CliError`].
    pub fn run(&self, context: &Context) -> Result<(), CliError> {
        match self {
            Self::NewScene(arguments) => new_scene::run(arguments, context),
            Self::GenDataset(arguments) => gen_dataset::run(arguments, context),
            Self::Verify(arguments) => verify::run(arguments, context),
            Self::Merge(arguments) => merge::run(arguments, context),
            Self::Splits(arguments) => splits::run(arguments, context),
            Self::Stats(arguments) => stats::run(arguments, context),
            Self::Simulate(arguments) => simulate::run(arguments, context),
            Self::Render(arguments) => render::run(arguments, context),
            Self::Eval(arguments) => eval::run(arguments, context),
            Self::Train(arguments) => train::run(arguments, context),
            Self::Benchmark(arguments) => benchmark::run(arguments, context),
            Self::Completions(arguments) => completions::run(arguments, context),
            Self::Man(arguments) => man::run(arguments, context),
        }
    }
}
