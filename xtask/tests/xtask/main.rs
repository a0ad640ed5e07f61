//! The development commands of `cargo xtask`, run as a program.

mod check_behaviour;
mod check_minds;
mod check_physics;
mod check_verify;
mod commands;
mod documents;
mod fit_inference;
mod fit_minds;
mod fit_reports;
mod results;
// Also used by the tests that follow documents.
#[path = "../../../crates/phase-cli/tests/cli/shell.rs"]
mod shell;
mod support;
mod tidy;
mod torture;

/// The program that is run.
const PROGRAM: &str = env!("CARGO_BIN_EXE_xtask");
