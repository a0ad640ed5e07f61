//! Results as a JSON file, or alone on stdout.

use crate::{
    error::CliError,
    output::{print_json, print_result},
    surroundings::STDOUT,
};
use clap::Args;
use phase_files::atomic;
use serde::Serialize;
use std::{
    fmt::Display,
    path::{Path, PathBuf},
};

/// The option `--json`.
#[derive(Args, Clone, Debug, Default)]
pub struct JsonFile {
    /// Print the results as one JSON object on stdout, and nothing else there; or, with a file, write them
    /// there too
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "-")]
    pub json: Option<PathBuf>,
}

impl JsonFile {
    /// Checks, before the work, that the file can be written and is none of these inputs.
    ///
    /// # Errors
    /// [`CliError::Usage`].
    pub fn check<'a>(&self, inputs: impl IntoIterator<Item = &'a PathBuf>) -> Result<(), CliError> {
        let file = self.json.as_ref().filter(|file| *file != Path::new(STDOUT));
        file.map_or(Ok(()), |file| check("--json", file, inputs))
    }

    /// Prints results as text, and writes them to the file if there is one; alone as JSON if there is none.
    ///
    /// # Errors
    /// [`CliError::Serialise`], [`CliError::Output`] or [`CliError::Stdout`].
    pub fn print(&self, results: &impl Serialize, text: impl Display) -> Result<(), CliError> {
        match self.json.as_deref() {
            Some(file) if file == Path::new(STDOUT) => return print_json(results),
            Some(file) => write(file, results)?,
            None => {}
        }
        print_result(text.to_string().trim_end())
    }
}

/// Checks that an option can write to a file that is neither one of the inputs nor in one of their folders.
///
/// # Errors
/// [`CliError::Usage`].
pub fn check<'a>(
    option: &str,
    out: &Path,
    inputs: impl IntoIterator<Item = &'a PathBuf>,
) -> Result<(), CliError> {
    let folder = out.parent().filter(|folder| !folder.as_os_str().is_empty());
    let place = out.canonicalize().or_else(|_| folder.unwrap_or(Path::new(".")).canonicalize());
    // A folder of inputs holds what its manifest says, and nothing else.
    let same = |input: &PathBuf| {
        let within = |input: PathBuf| place.as_ref().is_ok_and(|place| place.starts_with(input));
        out == input || input.canonicalize().is_ok_and(within)
    };
    let rule = if out.is_dir() {
        "is a folder; a file is needed"
    } else if folder.is_some_and(|folder| !folder.is_dir()) {
        "cannot be written, for its folder does not exist"
    } else if inputs.into_iter().any(same) {
        "is an input file or in an input folder; choose another"
    } else {
        return Ok(());
    };
    Err(CliError::Usage(format!("{option} {}: {rule}", out.display())))
}

/// Writes results to a file: whole, or not at all.
///
/// # Errors
/// [`CliError::Output`].
pub fn write(file: &Path, results: &impl Serialize) -> Result<(), CliError> {
    atomic::write_json(file, results).map_err(CliError::Output)
}
