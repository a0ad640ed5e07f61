//! `cargo xtask`: the commands of `phase` (the crate `phase_cli`), and development commands that need the
//! source of this workspace.
//!
//! - `book` makes a book of the documents,
//! - `check-physics` compares an engine with recorded motion,
//! - `check-behaviour` shows how reliably agents do what they are planned to do,
//! - `check-minds` compares minds with recorded agents,
//! - `fit-minds` fits the parameters of minds to recorded agents,
//! - `draw-behaviour` draws scenes for `check-behaviour` from the sampler,
//! - `playground` builds the WebAssembly first,
//! - `fuzz` runs the targets of `phase-fuzz`,
//! - `golden` runs the golden tests, also as another machine, or rewrites what they compare with,
//! - `leaderboard` scores the predictions in `docs/leaderboard`,
//! - `results` rewrites the documents that show results,
//! - `tidy` checks what the compiler cannot.
//!
//! Key design decision: development commands are not installed, since they are useless without the source.
//! The trade-off is a second program with the same commands.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod book;
pub mod check_behaviour;
pub mod check_engines;
pub mod check_minds;
pub mod check_physics;
pub mod check_verify;
pub mod cli;
pub mod draw_behaviour;
pub mod error;
mod evaluations_file;
pub mod fit_events;
pub mod fit_forecast;
pub mod fit_inference;
pub mod fit_minds;
pub mod fit_reports;
pub mod fuzz;
pub mod golden;
pub mod json_file;
pub mod leaderboard;
pub mod results;
mod rooms;
pub mod tidy;
pub mod torture;
pub mod wasm;

use clap::CommandFactory;
use phase_cli::{context::Program, program};
use std::{ffi::OsString, process::ExitCode};

/// The program `cargo xtask`.
pub const XTASK: Program = Program {
    name: "cargo xtask",
    serve_hint: "use `cargo serve`",
    networks_hint: "use `cargo xtask-networks` in place of `cargo xtask`",
    studies_hint: "use `cargo xtask-studies` in place of `cargo xtask`",
    // The installed program is `phase`.
    interface: phase_cli::cli::Cli::command,
};

/// Runs a command line, program name first, and returns its exit code.
pub fn main_with(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    program::main_with::<cli::Cli>(XTASK, arguments)
}
