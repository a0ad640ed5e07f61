//! `cargo xtask`: the commands of `phase`, and chores of this repository.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

use std::process::ExitCode;

fn main() -> ExitCode {
    xtask::main_with(std::env::args_os())
}
