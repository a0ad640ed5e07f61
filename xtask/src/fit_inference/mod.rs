//! `fit-inference`: fits how SIMPLE weighs its evidence to events whose labels are known.
//!
//! Every intent of both agents is simulated once with each kind of minds. Three numbers say what the evidence is worth: the
//! weight κ of what the minds would choose, the exponent a of the intent network's guess, and the rate ε at which minds of a kind
//! lapse. All combinations on a grid are compared by the log posterior of the true goals and attitudes, averaged over the kinds,
//! and every fold of the events is held out of one fit. Beside that, κ is measured without labels being fitted: as one over the
//! integrated autocorrelation time of the log likelihood ratios of the intents.

mod autocorrelation;
mod grid;
mod kept;
pub mod options;
mod report;
mod subject;
mod weights;

use crate::{
    check_minds::{self, parameters},
    error::XtaskError,
    fit_minds::folds,
    json_file,
};
use grid::Grid;
use kept::KeptEvidence;
use options::FitInference;
use phase_agent::MindParameters;
use phase_cli::{
    console::{self, print_result},
    context::Context,
    error::CliError,
    interrupt,
    output::json_text,
};
use phase_event::Recording;
use phase_simple::{Algorithm, AlternativeMinds, InferenceSettings, InversePlanningSettings};
use report::{Fold, Report};
use std::path::Path;
use weights::Weights;

/// Runs the command.
///
/// # Errors
/// Any [`XtaskError`] about the files, or an interruption.
pub fn run(arguments: &FitInference, context: &Context) -> Result<(), XtaskError> {
    if let Some(out) = &arguments.out {
        let inputs = arguments.events.iter().chain(&arguments.held_out).chain(&arguments.parameters);
        json_file::check("--out", out, inputs.map(|file| file.as_path()))?;
    }
    let settings = settings(arguments)?;
    let mut recordings = Vec::new();
    for file in &arguments.events {
        recordings.extend(some(arguments, file, context)?);
    }
    let (own, folds) = (recordings.len(), usize::from(arguments.folds));
    if own < folds {
        let rule = format!("--events: {}, fewer than --folds {folds}", console::events(own));
        return Err(CliError::Usage(rule).into());
    }
    for recording in recordings.iter().take(1) {
        parameters::check(settings.minds, &recording.scene, arguments.parameters.as_deref())?;
    }
    let mut held_out = Vec::new();
    for file in &arguments.held_out {
        held_out.push((file.display().to_string(), some(arguments, file, context)?));
    }
    interrupt::listen();
    let planning = planning(arguments, &settings);
    let present = Weights::of(&settings, &planning);
    let kinds: Vec<MindParameters> =
        core::iter::once(settings.minds).chain(settings.alternative.map(|it| it.minds)).collect();
    let evidence = KeptEvidence::new(&kinds, planning, arguments, context)?;
    let subjects = evidence.of(&recordings)?;
    let grid = Grid::of(&subjects, &present);
    let mut others = Vec::with_capacity(held_out.len());
    for (file, recordings) in held_out {
        others.push((file, Grid::of(&evidence.of(&recordings)?, &present)));
    }
    let named: Vec<_> = grid.events().collect();
    let fold_of = folds::assign(&named, folds, arguments.seed);
    let fold = |fold| {
        let (validation, training): (Vec<usize>, Vec<usize>) = (0..own).partition(|&k| fold_of[k] == fold);
        Fold { weights: grid.fit(&training), validation }
    };
    let all: Vec<usize> = (0..own).collect();
    let report = Report {
        folds: (0..folds).map(fold).collect(),
        fitted: grid.fit(&all),
        autocorrelation_time: autocorrelation::time(&subjects, &present),
        present,
        grid: &grid,
        held_out: &others,
    };
    json_file::write(arguments.out.as_deref(), &json_text(&report.fitted, "the weights")?)?;
    print_result(report.text().trim_end());
    Ok(())
}

/// SIMPLE's settings with the minds that were asked for: both kinds, unless one was named or given.
fn settings(arguments: &FitInference) -> Result<InferenceSettings, CliError> {
    let one = InferenceSettings::default();
    let given = arguments.parameters.as_deref().map(parameters::read).transpose()?;
    let mut settings = match (given, arguments.minds) {
        (Some(minds), _) => one.with_minds(MindParameters {
            simulations: InferenceSettings::minds_of(minds.kind).simulations,
            ..minds
        }),
        (None, Some(kind)) => one.with_minds(InferenceSettings::minds_of(kind)),
        (None, None) => InferenceSettings::averaged(),
    };
    if let Some(simulations) = arguments.simulations {
        let simulations = simulations as usize;
        settings.minds.simulations = simulations;
        settings.alternative = settings
            .alternative
            .map(|it| AlternativeMinds { minds: MindParameters { simulations, ..it.minds }, ..it });
    }
    Ok(settings)
}

/// How these settings weigh what minds would choose.
fn planning(arguments: &FitInference, settings: &InferenceSettings) -> InversePlanningSettings {
    let planning = match settings.algorithm {
        Algorithm::InversePlanning(planning) => planning,
        Algorithm::Chains(_) => InversePlanningSettings::default(),
    };
    InversePlanningSettings {
        interval: arguments.interval.map_or(planning.interval, usize::from),
        ..planning
    }
}

/// The events of a file, as many as were asked for.
fn some(arguments: &FitInference, file: &Path, context: &Context) -> Result<Vec<Recording>, CliError> {
    let mut recordings = check_minds::recordings(file, None, context)?;
    recordings.truncate(arguments.limit.map_or(usize::MAX, |limit| limit as usize));
    Ok(recordings)
}
