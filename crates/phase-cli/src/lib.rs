//! The PHASE command line.
//!
//! - `gen-dataset` makes social events from a preset and a seed,
//! - `verify` checks that a dataset is whole,
//! - `merge` puts the shards of a dataset together,
//! - `splits` checks how a dataset is divided, or divides it,
//! - `stats` shows the paper's figures beside a dataset's own,
//! - `simulate` plays the scenes of a `phase-events/1` file,
//! - `render` turns events into videos and pictures,
//! - `check-physics` holds an engine against recorded motion,
//! - `check-behaviour` shows how reliably agents do what they are planned to do,
//! - `eval` measures how well a method perceives events,
//! - `benchmark` measures all methods and puts them beside what is published,
//! - `tidy` checks what the compiler cannot.
//!
//! The key design decision is that a command says what is wrong in one plain sentence and an exit code: 0 done,
//! 1 a failure of the program or the machine, 2 something about the input or the output folder, 130 interrupted.
//! The price is an error type that lists every way to fail.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod benchmark;
pub mod captions;
pub mod check_behaviour;
pub mod check_physics;
pub mod cli;
pub mod console;
pub mod engine;
pub mod error;
pub mod eval;
pub mod gen_dataset;
pub mod interrupt;
pub mod parallel;
pub mod picture;
pub mod production;
pub mod progress;
pub mod render;
pub mod simulate;
pub mod source;
pub mod splits;
pub mod stats;
pub mod tidy;
pub mod verify;

use clap::Parser;
use cli::{Cli, Command};
use console::remark;
use error::CliError;
use std::{ffi::OsString, process::ExitCode};

/// Runs a command line, program name first, and returns its exit code.
pub fn main_with(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    match Cli::try_parse_from(arguments) {
        Ok(cli) => match run(cli.command) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                remark(format!("error: {error}"));
                ExitCode::from(error.exit_code())
            }
        },
        Err(error) if !error.use_stderr() => {
            // Help or version was asked for; a closed pipe is no reason to complain.
            let _ = error.print();
            ExitCode::SUCCESS
        }
        Err(error) => {
            remark(cli::one_sentence(&error));
            ExitCode::from(2)
        }
    }
}

/// Runs one command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(command: Command) -> Result<(), CliError> {
    match command {
        Command::GenDataset(arguments) => gen_dataset::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
        Command::Merge(arguments) => gen_dataset::merge::run(&arguments),
        Command::Splits(arguments) => splits::run(&arguments),
        Command::Stats(arguments) => stats::run(&arguments),
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::Render(arguments) => render::run(&arguments),
        Command::CheckPhysics(arguments) => check_physics::run(&arguments),
        Command::CheckBehaviour(arguments) => check_behaviour::run(&arguments),
        Command::Eval(arguments) => eval::run(&arguments),
        Command::Benchmark(arguments) => benchmark::run(&arguments),
        Command::Tidy => tidy::run(),
    }
}
