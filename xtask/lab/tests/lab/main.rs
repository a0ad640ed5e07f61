//! The commands of the lab, run as a program.

mod check_behaviour;
mod check_forecasts;
mod check_minds;
mod check_physics;
mod fit_beliefs;
mod fit_inference;
mod fit_intents;
mod fit_minds;
mod fit_reports;
// Shared with the tests of the program `phase`; not everything is used here.
#[allow(dead_code)]
#[path = "../../../../crates/phase-cli/tests/cli/support.rs"]
mod support;

/// The program that is run.
const PROGRAM: &str = env!("CARGO_BIN_EXE_phase-lab");
