//! `man`: the manual, a page for each command.

use crate::{context::Context, error::CliError, output::print_result};
use clap::Args;
use clap_mangen::Man;
use phase_files::{WriteError, atomic};
use std::path::{Path, PathBuf};

/// Options of `man`.
#[derive(Args, Debug)]
pub struct ManPages {
    /// Folder for the pages, such as ~/.local/share/man/man1
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

/// Runs the command: `phase.1`, and a page such as `phase-simulate.1` for each command below it.
///
/// # Errors
/// [`CliError::Output`] if a page cannot be written.
pub fn run(arguments: &ManPages, context: &Context) -> Result<(), CliError> {
    let out = &arguments.out;
    std::fs::create_dir_all(out).map_err(|source| failed(out, "create the folder", source))?;
    let mut command = (context.program.interface)();
    command.build();
    let pages = write(out, &command)?;
    print_result(format!("{pages} pages in {}", out.display()))
}

/// Writes the page of a command and those of the commands below it, and returns how many there are.
fn write(out: &Path, command: &clap::Command) -> Result<usize, CliError> {
    // For a command below another one the joined words: `phase-eval-goals`.
    let name = command.get_display_name().unwrap_or_else(|| command.get_name());
    let file = out.join(format!("{name}.1"));
    let mut page = Vec::new();
    let man = Man::new(command.clone());
    man.render(&mut page).map_err(|source| failed(&file, "compose the page", source))?;
    atomic::write(&file, &page).map_err(CliError::Output)?;
    let inner = command.get_subcommands().filter(|inner| inner.get_name() != "help");
    inner.map(|inner| write(out, inner)).sum::<Result<usize, CliError>>().map(|pages| pages + 1)
}

fn failed(path: &Path, action: &'static str, source: std::io::Error) -> CliError {
    CliError::Output(WriteError { path: path.to_owned(), action, source })
}
