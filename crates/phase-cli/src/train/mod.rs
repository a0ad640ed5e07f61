//! Trains what PHASE learns from data: `cargo train strength --data DIR --out FILE`.
//!
//! As with `cargo xtask`, what goes wrong is one plain sentence and an exit code: 0 done, 1 a failure of the program or
//! the machine, 2 something about the input or the output file.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod error;
mod events;
mod forecasting;
mod kept;
mod network;
mod recognition;
mod strength;

use clap::{Args, Parser, Subcommand};
use std::{
    io::{self, Write},
    path::PathBuf,
    process::ExitCode,
};

/// Train the neural networks of PHASE on a dataset
#[derive(Parser, Debug)]
#[command(name = "cargo train", bin_name = "cargo train", version)]
struct Cli {
    /// What to train.
    #[command(subcommand)]
    command: Command,
}

/// What to train.
#[derive(Subcommand, Debug)]
enum Command {
    /// SIMPLE's guess at the agents' strengths
    Strength(Options),
    /// 2-Level LSTM, a baseline for goals and relations
    TwoLevelLstm(NetworkOptions),
    /// Actor relation graph, a baseline for goals and relations
    Arg(NetworkOptions),
    /// Social-LSTM, a baseline for trajectories
    SocialLstm(NetworkOptions),
    /// Spatial-temporal graph attention, a baseline for trajectories
    Stgat(NetworkOptions),
}

/// On what, and where to.
#[derive(Args, Debug)]
struct Options {
    /// Folder of a finished dataset that is divided into train, validation and test
    #[arg(long, value_name = "DIR")]
    data: PathBuf,
    /// Learn from the first N training events only
    #[arg(long, value_name = "N", value_parser = at_least_one)]
    events: Option<usize>,
    /// Folder of the dataset to validate on, and to test with; by default the one to learn from
    #[arg(long, value_name = "DIR")]
    validation: Option<PathBuf>,
    /// File for the weights (safetensors)
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Seed of all chance in the training
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Also measure what was learnt on the test events, once, at the end
    #[arg(long)]
    test: bool,
}

/// The same, and how long.
#[derive(Args, Debug)]
struct NetworkOptions {
    #[command(flatten)]
    options: Options,
    /// Rounds of learning at most
    #[arg(long, value_name = "N", value_parser = at_least_one)]
    rounds: Option<usize>,
}

/// A number of events or rounds.
fn at_least_one(text: &str) -> Result<usize, String> {
    text.parse().ok().filter(|number| *number > 0).ok_or_else(|| "must be a whole number above 0".into())
}

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Strength(options) => strength::run(&options),
        Command::TwoLevelLstm(options) => recognition::two_level_lstm(&options),
        Command::Arg(options) => recognition::arg(&options),
        Command::SocialLstm(options) => forecasting::social_lstm(&options),
        Command::Stgat(options) => forecasting::stgat(&options),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            remark(format!("error: {error}"));
            ExitCode::from(error.exit_code())
        }
    }
}

/// Writes a result to stdout, on a line of its own. That nobody listens any more is no failure.
fn tell(line: impl core::fmt::Display) {
    let _ = writeln!(io::stdout(), "{line}");
}

/// Writes a remark to stderr, on a line of its own.
fn remark(line: impl core::fmt::Display) {
    let _ = writeln!(io::stderr(), "{line}");
}
