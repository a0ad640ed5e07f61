//! `study`: rating studies, from the configuration to the figures.

#[cfg(feature = "serve")]
mod answers;
#[cfg(feature = "serve")]
mod check;
#[cfg(feature = "serve")]
mod new;
pub mod options;
#[cfg(feature = "serve")]
mod ratings;
#[cfg(feature = "serve")]
mod videos;

use crate::{context::Context, error::CliError};
use options::Study;

/// Runs the command.
///
/// # Errors
/// Any [`CliError`]; [`CliError::NotBuilt`] where the program was built without the feature `serve`.
#[cfg(feature = "serve")]
pub fn run(arguments: &Study, context: &Context) -> Result<(), CliError> {
    match arguments {
        Study::New(options) => new::run(options, context),
        Study::Check(options) => check::run(options, context),
        Study::Export(options) => answers::export(options),
        Study::Report(options) => answers::report(options),
        Study::Backup(options) => answers::backup(options),
        Study::Ratings(options) => ratings::run(options),
    }
}

/// Says what to do instead.
///
/// # Errors
/// [`CliError::NotBuilt`], always.
#[cfg(not(feature = "serve"))]
pub const fn run(_: &Study, context: &Context) -> Result<(), CliError> {
    Err(CliError::NotBuilt { part: "rating studies", hint: context.program.serve_hint })
}
