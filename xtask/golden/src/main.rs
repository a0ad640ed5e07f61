//! The program of the library `phase_golden`, started by `cargo xtask`.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

use clap::Parser;
use phase_golden::command::Cli;
use std::process::ExitCode;

fn main() -> ExitCode {
    match Cli::parse().run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
