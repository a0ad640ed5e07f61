//! The commands of PHASE, and the program `phase` that runs them.
//!
//! - `new-scene` writes an initial scene,
//! - `gen-dataset` generates social events from a preset and a seed,
//! - `verify` checks that a dataset is complete,
//! - `merge` combines the shards of a dataset,
//! - `splits` checks how a dataset is divided, or divides it,
//! - `stats` compares the paper's figures with a dataset's own,
//! - `simulate` simulates the scenes of a `phase-events/1` file,
//! - `render` turns events into videos and pictures,
//! - `narrate` tells in words what happens in events,
//! - `questions` makes a benchmark of questions about events, `score` scores answers,
//! - `seal` publishes a dataset without its labels, `unseal` proves later what they were,
//! - `eval` measures how well a method perceives events,
//! - `train` trains neural networks (feature `networks`),
//! - `benchmark` evaluates all methods and compares them with published results,
//! - `submit` checks and scores a method for the leaderboard,
//! - `playground` writes the playground as static files,
//! - `study` prepares rating studies, and exports and analyses their answers (feature `studies`),
//! - `serve` serves the playground, the two-player game and the admin page (feature `serve`),
//! - `completions` and `man` describe the program to shells and to `man`.
//!
//! `cargo xtask` runs the same commands and those that need the source of this workspace.
//!
//! Key design decision: a command reports an error as one plain sentence and an exit code: 0 done, 1 a
//! failure of the program or the machine, 2 a problem of the input or the output folder, 130 interrupted. The
//! trade-off is an error type that lists every way to fail.
//!
//! A dataset of one short event is generated and verified; once a file of it is damaged, verification fails:
//!
//! ```
//! use phase_cli::main_with;
//! use std::{ffi::OsString, fs, process::ExitCode};
//!
//! let folder = tempfile::tempdir()?;
//! let out = folder.path().to_string_lossy();
//! let phase = |arguments: &[&str]| main_with(["phase"].iter().chain(arguments).map(OsString::from));
//!
//! let effort = ["--max-steps", "2", "--simulations", "10", "--particles", "5"];
//! let made = phase(&[&["gen-dataset", "--events", "1", "--no-video", "--out", &out], &effort[..]].concat());
//! assert_eq!(made, ExitCode::SUCCESS);
//! assert_eq!(phase(&["verify", &out]), ExitCode::SUCCESS);
//!
//! fs::write(folder.path().join("events/demo-0000.json"), "{}")?;
//! assert_eq!(phase(&["verify", &out]), ExitCode::from(2));
//! # Ok::<(), std::io::Error>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod address;
pub mod benchmark;
pub mod cli;
pub mod completions;
pub mod console;
pub mod context;
pub mod effort;
pub mod error;
pub mod eval;
pub mod export;
pub mod gen_dataset;
pub mod interrupt;
pub mod json_file;
pub mod laboratory;
pub mod look;
pub mod man;
pub mod named;
pub mod narrate;
pub mod new_scene;
pub mod output;
pub mod parallel;
pub mod playground;
pub mod program;
pub mod progress;
pub mod questions;
pub mod render;
pub mod seal;
pub mod serve;
pub mod shard_option;
pub mod simulate;
pub mod splits;
pub mod stats;
pub mod study;
pub mod submit;
mod surroundings;
pub mod track;
pub mod train;
pub mod verify;

use clap::CommandFactory;
use context::Program;
use std::{ffi::OsString, process::ExitCode};

/// The program `phase`.
pub const PHASE: Program = Program {
    name: "phase",
    networks_hint: "install `phase` with them (`cargo install --path crates/phase-cli --features networks`)",
    serve_hint: "install `phase` with its default features (`cargo install --path crates/phase-cli`)",
    interface: cli::Cli::command,
};

/// The program `cargo xtask`, and the packages that it starts.
pub const CARGO_XTASK: Program = Program {
    name: "cargo xtask",
    networks_hint: "use `cargo xtask-networks` in place of `cargo xtask`",
    serve_hint: "use `cargo xtask-serve` in place of `cargo xtask`",
    // The installed program is `phase`.
    interface: cli::Cli::command,
};

/// Runs a command line of `phase`, program name first, and returns its exit code.
pub fn main_with(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    program::main_with::<cli::Command>(PHASE, arguments)
}
