//! The program `phase`; see the library `phase_cli`.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

use std::process::ExitCode;

fn main() -> ExitCode {
    phase_cli::main_with(std::env::args_os())
}
