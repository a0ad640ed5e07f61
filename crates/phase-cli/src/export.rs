//! `export`: a dataset as WebDataset, tar files that training programs read from the first byte to the last.

use crate::{context::Context, error::CliError, interrupt, output::Output};
use clap::{Args, value_parser};
use phase_files::told;
use phase_model::setting::EVENTS;
use phase_runs::{
    export::{Exported, export},
    words,
};
use serde_json::json;
use std::path::PathBuf;

/// Options of `export`.
#[derive(Args, Debug)]
pub struct Export {
    /// Folder of a finished dataset
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Folder for the tar files; new, empty, or of the same export
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Events in a tar file, 1 to 1000000
    #[arg(
        long,
        value_name = "N",
        default_value_t = 500,
        value_parser = value_parser!(u32).range(EVENTS.bounds())
    )]
    pub events_per_file: u32,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &Export, context: &Context) -> Result<(), CliError> {
    interrupt::listen();
    let out = &arguments.out;
    let exported = export(&arguments.folder, out, arguments.events_per_file as usize, context)?;
    let Exported { files, is_new } = exported;
    let text = if is_new {
        let files = words::counted(files.len(), "tar file", "tar files");
        format!("{files} in {}", out.display())
    } else {
        format!("{} holds this export already", out.display())
    };
    arguments.output.print(text, &json!({ "folder": told(out), "files": files, "new": is_new }))
}
