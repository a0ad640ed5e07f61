//! `seal` and `unseal`: datasets whose labels are published later.

use crate::{context::Context, error::CliError, output::Output};
use clap::Args;
use phase_runs::seal::{seal, unseal};
use serde_json::json;
use std::path::PathBuf;

/// Options of `seal`.
#[derive(Args, Debug)]
pub struct SealOptions {
    /// Folder of a finished dataset that was generated from a secret random seed
    #[arg(value_name = "DIR")]
    pub dataset: PathBuf,
    /// Folder of questions about this dataset, which are published without answers
    #[arg(long, value_name = "DIR")]
    pub questions: Option<PathBuf>,
    /// New folder for what is published
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Runs `seal`.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &SealOptions, context: &Context) -> Result<(), CliError> {
    let sealed = seal(&arguments.dataset, arguments.questions.as_deref(), &arguments.out, context)?;
    let out = arguments.out.display();
    let text = format!(
        "{} events are sealed in {out}; publish this folder, and keep the dataset\nmanifest {}\n",
        sealed.events, sealed.manifest_sha256
    );
    arguments.output.print(text, &sealed)
}

/// Options of `unseal`.
#[derive(Args, Debug)]
pub struct UnsealOptions {
    /// Folder that was published
    #[arg(value_name = "DIR")]
    pub published: PathBuf,
    /// Folder of the dataset
    #[arg(long, value_name = "DIR")]
    pub dataset: PathBuf,
    /// Folder of the questions, if they were sealed, too
    #[arg(long, value_name = "DIR")]
    pub questions: Option<PathBuf>,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Runs `unseal`.
///
/// # Errors
/// Any [`CliError`].
pub fn run_unseal(arguments: &UnsealOptions, context: &Context) -> Result<(), CliError> {
    let UnsealOptions { published, dataset, questions, output } = arguments;
    let names = unseal(published, dataset, questions.as_deref(), context)?;
    let text = format!(
        "{} holds what was sealed: {} events, byte for byte those of {}\n",
        published.display(),
        names.len(),
        dataset.display()
    );
    output.print(text, &json!({ "events": names }))
}
