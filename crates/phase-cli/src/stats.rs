//! `stats`: the paper's figures compared with those of a dataset or of other events, and plots of them.

use crate::{context::Context, error::CliError, output::Output, parallel::Jobs, surroundings};
use clap::Args;
use phase_runs::{figures::EventFigures, motion::Answers};
use std::path::{Path, PathBuf};

/// Options of `stats`.
#[derive(Args, Debug)]
pub struct Stats {
    /// A file in the format phase-events/1, or the folder of a dataset or of simulations
    #[arg(value_name = "FILE|DIR")]
    pub events: PathBuf,
    /// Also write the figures, plots (SVG) and the motion in each video (motion.csv) into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Results of `eval goals` for these events: also show the probability that people report the label (if
    /// the method is simple), and how many goals are right where motion shows the landmark by 1 u or more
    #[arg(long, value_name = "FILE")]
    pub results: Option<PathBuf>,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
    /// Number of files at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// Runs the command.
///
/// # Errors
/// If the events cannot be used or the plots cannot be written.
pub fn run(arguments: &Stats, context: &Context) -> Result<(), CliError> {
    arguments.out.as_deref().map_or(Ok(()), surroundings::check_itself).map_err(CliError::Usage)?;
    let read = |results: &Path| Answers::read(results, &arguments.events);
    let answers = arguments.results.as_deref().map(read).transpose()?;
    let mut figures = EventFigures::of(&arguments.events, arguments.jobs.given(), context)?;
    if let Some(answers) = answers {
        figures = figures.with_answers(answers)?;
    }
    if let Some(out) = &arguments.out {
        figures.write(out).map_err(CliError::Output)?;
        context.note(format!("figures and plots in {}", out.display()));
    }
    arguments.output.print(figures.report(), &figures.value())
}
