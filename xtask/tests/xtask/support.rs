//! Running the program and inspecting its output, as the tests of the command line do.

// Not everything is used here.
#[allow(dead_code)]
#[path = "../../../crates/phase-cli/tests/cli/support.rs"]
mod shared;

pub(crate) use shared::{QUICK, phase as xtask, recording, refuse, run, succeed, text, tree, write_events};
