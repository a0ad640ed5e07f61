//! Tests of promises about files, run as a program for as long as a test may take.

mod check_verify;
mod torture;
// Shared with the tests of the program `phase`; not everything is used here.
#[allow(dead_code)]
#[path = "../../../../crates/phase-cli/tests/cli/support.rs"]
mod support;

/// The program that is run.
const PROGRAM: &str = env!("CARGO_BIN_EXE_phase-torture");
