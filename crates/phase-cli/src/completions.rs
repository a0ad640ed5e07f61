//! `completions`: a script with which a shell completes commands and options.

use crate::{context::Context, error::CliError};
use clap::Args;
use clap_complete::{Shell, generate};
use std::io::Write;

/// Options of `completions`.
#[derive(Args, Debug)]
pub struct Completions {
    /// The shell that is to complete, such as bash, zsh or fish
    pub shell: Shell,
}

/// Runs the command: the script goes to stdout.
///
/// # Errors
/// None at present; the reader of the script may stop at any time.
pub fn run(arguments: &Completions, context: &Context) -> Result<(), CliError> {
    let mut command = (context.program.interface)();
    let name = command.get_name().to_owned();
    let mut script = Vec::new();
    generate(arguments.shell, &mut command, name, &mut script);
    // A closed pipe is not a failure.
    let _ = std::io::stdout().write_all(&script);
    Ok(())
}
