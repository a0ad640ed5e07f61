//! `fit-inference`: fits how SIMPLE weighs its evidence to events whose labels are known.
//!
//! Every intent of both agents is simulated once. Three numbers say what the simulations are worth: the weight κ of
//! what the minds would choose, the weight β of how far they stray, and the rate ε at which minds lapse. All
//! combinations on a grid are compared by the log posterior of the true goals and attitudes, and every fold of the
//! events is held out of one fit.

mod grid;
pub mod options;
mod report;
mod subject;

use crate::{
    check_minds::{self, parameters},
    error::XtaskError,
    fit_minds::folds,
};
use core::ops::ControlFlow;
use grid::{Grid, Weights};
use options::FitInference;
use phase_agent::MindParameters;
use phase_cli::{
    console::{self, print_result},
    context::Context,
    error::CliError,
    interrupt,
    parallel::make_all,
};
use phase_event::Recording;
use phase_model::AGENT_COUNT;
use report::{Fold, Report};
use subject::{INTENTS, Subject};

/// Runs the command.
///
/// # Errors
/// Any [`XtaskError`] about the files, or an interruption.
pub fn run(arguments: &FitInference, context: &Context) -> Result<(), XtaskError> {
    let given = arguments.parameters.as_deref().map(parameters::read).transpose()?;
    let simulations = arguments.simulations as usize;
    let minds = MindParameters { simulations, ..given.unwrap_or_default() };
    let recordings = check_minds::recordings(&arguments.events, None, context)?;
    let (own, folds) = (recordings.len(), usize::from(arguments.folds));
    if own < folds {
        let rule = format!(
            "{}: has {}, fewer than --folds {folds}",
            arguments.events.display(),
            console::events(own)
        );
        return Err(CliError::Usage(rule).into());
    }
    for recording in recordings.iter().take(1) {
        parameters::check(minds, &recording.scene, arguments.parameters.as_deref())?;
    }
    let generated = match &arguments.generated {
        Some(file) => check_minds::recordings(file, None, context)?,
        None => Vec::new(),
    };
    interrupt::listen();
    let grid = Grid::of(&subjects(&recordings, minds, arguments, context)?);
    let named: Vec<_> = grid.events().collect();
    let fold_of = folds::assign(&named, folds, arguments.seed);
    let fold = |fold| {
        let (validation, training): (Vec<usize>, Vec<usize>) = (0..own).partition(|&k| fold_of[k] == fold);
        Fold { weights: grid.fit(&training), validation }
    };
    let all: Vec<usize> = (0..own).collect();
    let held_out = Grid::of(&subjects(&generated, minds, arguments, context)?);
    let report = Report {
        folds: (0..folds).map(fold).collect(),
        fitted: grid.fit(&all),
        present: Weights::present(),
        grid: &grid,
        generated: &held_out,
    };
    print_result(report.text().trim_end());
    Ok(())
}

/// All intents of all events, simulated.
fn subjects(
    recordings: &[Recording],
    minds: MindParameters,
    arguments: &FitInference,
    context: &Context,
) -> Result<Vec<Subject>, XtaskError> {
    let activity = format!("simulating the intents of {}", console::events(recordings.len()));
    let progress = context.progress_over(&activity, recordings.len() * INTENTS * AGENT_COUNT);
    let subjects = make_all(&arguments.jobs, recordings.len(), |k| {
        let mut ticks = 0;
        let subject = Subject::new(&recordings[k], minds, arguments.seed, &mut || {
            ticks += 1;
            progress.step();
            if interrupt::requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })?;
        progress.event(ticks, &recordings[k].id);
        Ok(subject)
    })?;
    subjects.ok_or(XtaskError::Interrupted)
}
