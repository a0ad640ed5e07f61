//! The program of the library `phase_torture`, started by `cargo xtask`.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

use phase_cli::{CARGO_XTASK, program};
use phase_torture::cli::Command;
use std::process::ExitCode;

fn main() -> ExitCode {
    program::main_with::<Command>(CARGO_XTASK, std::env::args_os())
}
