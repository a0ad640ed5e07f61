//! `check-engines`: both engines in random scenes.

use crate::error::XtaskError;
use clap::Args;
use phase_cli::{console::print_result, context::Context};
use phase_fuzz::engines;

/// Options of `check-engines`.
#[derive(Args, Debug)]
pub struct CheckEngines {
    /// Scenes of each kind
    #[arg(long, value_name = "N", default_value = "1000")]
    pub scenes: u32,
    /// The first of the seeds of the scenes
    #[arg(long, value_name = "N", default_value = "0")]
    pub seed: u32,
}

/// Runs the command.
///
/// # Errors
/// None; the result is what was measured.
pub fn run(arguments: &CheckEngines, context: &Context) -> Result<(), XtaskError> {
    let first = u64::from(arguments.seed);
    print_result(engines::report(first..first + u64::from(arguments.scenes), |what| context.note(what)));
    Ok(())
}
