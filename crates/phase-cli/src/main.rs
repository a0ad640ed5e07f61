//! The PHASE command line: `cargo xtask gen-dataset`, `simulate`, `render`, `check-physics`, `tidy`.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

use std::process::ExitCode;

fn main() -> ExitCode {
    xtask::main_with(std::env::args_os())
}
