//! `cargo xtask`: the commands of `phase` (the crate `phase_cli`), and chores of this repository.
//!
//! - `book` makes a book of the documents,
//! - `leaderboard` scores the predictions in `data/leaderboard`,
//! - `playground` builds the WebAssembly first,
//! - `results` rewrites the documents that show results,
//! - `tidy` checks what the compiler cannot.
//!
//! Commands of the packages below `xtask/` are listed in [`packages`].
//!
//! Key design decision: a command that only people who work on PHASE need is in a package of its own, which
//! is built when it is asked for: `cargo xtask gen-dataset` builds none of them. The price is a second start
//! of cargo for such a command.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod book;
pub mod cli;
pub mod error;
pub mod leaderboard;
pub mod packages;
pub mod results;
pub mod tidy;
pub mod wasm;

use phase_cli::{CARGO_XTASK, program};
use std::{ffi::OsString, process::ExitCode};

/// Runs a command line, program name first, and returns its exit code.
pub fn main_with(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    program::main_with::<cli::Command>(CARGO_XTASK, packages::with_help(arguments))
}
