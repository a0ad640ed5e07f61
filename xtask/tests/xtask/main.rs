//! The chores of `cargo xtask`, run as a program.

mod commands;
mod documents;
mod packages;
mod readmes;
mod results;
// Also used by the tests that follow documents.
#[path = "../../../crates/phase-cli/tests/cli/shell.rs"]
mod shell;
// Shared with the tests of the program `phase`; not everything is used here.
#[allow(dead_code)]
#[path = "../../../crates/phase-cli/tests/cli/support.rs"]
mod support;
mod tidy;

/// The program that is run.
const PROGRAM: &str = env!("CARGO_BIN_EXE_xtask");
