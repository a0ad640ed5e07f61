//! `check-engines`: both engines in random scenes.

use crate::engines;
use clap::Args;
use phase_cli::{context::Context, error::CliError, output::print_result};

/// Options of `check-engines`.
#[derive(Args, Debug)]
pub struct CheckEngines {
    /// Scenes of each kind
    #[arg(long, value_name = "N", default_value = "1000")]
    scenes: u32,
    /// The first of the seeds of the scenes
    #[arg(long, value_name = "N", default_value = "0")]
    seed: u32,
}

/// Runs the command: prints what was measured.
///
/// # Errors
/// If they cannot be printed.
pub(super) fn run(arguments: &CheckEngines, context: &Context) -> Result<(), CliError> {
    let first = u64::from(arguments.seed);
    print_result(engines::report(first..first + u64::from(arguments.scenes), |what| context.note(what)))
}
