//! `study`: rating studies, from the configuration to the figures.

#[cfg(feature = "studies")]
mod answers;
#[cfg(feature = "studies")]
mod check;
#[cfg(feature = "studies")]
mod new;
pub mod options;
#[cfg(feature = "studies")]
mod videos;

use crate::{context::Context, error::CliError};
use options::Study;

/// Runs the command.
///
/// # Errors
/// Any [`CliError`]; [`CliError::NoStudies`] where the program was built without the feature `studies`.
#[cfg(feature = "studies")]
pub fn run(arguments: &Study, context: &Context) -> Result<(), CliError> {
    match arguments {
        Study::New(options) => new::run(options, context),
        Study::Check(options) => check::run(options, context),
        Study::Export(options) => answers::export(options),
        Study::Report(options) => answers::report(options),
    }
}

/// Says what to do instead.
///
/// # Errors
/// [`CliError::NoStudies`], always.
#[cfg(not(feature = "studies"))]
pub const fn run(_: &Study, context: &Context) -> Result<(), CliError> {
    Err(CliError::NoStudies { hint: context.program.studies_hint })
}
