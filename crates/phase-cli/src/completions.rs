//! `completions`: a script with which a shell completes commands and options.

use crate::{console::write_result, context::Context, error::CliError};
use clap::Args;
use clap_complete::{Shell, generate};

/// Options of `completions`.
#[derive(Args, Debug)]
pub struct Completions {
    /// The shell that is to complete, such as bash, zsh or fish
    pub shell: Shell,
}

/// Runs the command: the script goes to stdout.
///
/// # Errors
/// [`CliError::Stdout`].
pub fn run(arguments: &Completions, context: &Context) -> Result<(), CliError> {
    let mut command = (context.program.interface)();
    let name = command.get_name().to_owned();
    let mut script = Vec::new();
    generate(arguments.shell, &mut command, name, &mut script);
    Ok(write_result(&String::from_utf8_lossy(&script))?)
}
