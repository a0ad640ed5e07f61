//! `fit-inference`: fits how SIMPLE weighs its evidence to events whose labels are known.
//!
//! Every intent of both agents is simulated once with each kind of minds. Three numbers say what the evidence
//! is worth: the weight κ of what the minds would choose, the exponent a of the intent network's guess, and
//! the rate ε at which minds of a kind lapse. All combinations on a grid are compared by the log posterior of
//! the true goals and attitudes, averaged over the kinds, and every fold of the events is held out of one
//! fit. Beside that, κ is measured without labels being fitted: as one over the integrated autocorrelation
//! time of the log likelihood ratios of the intents.

mod autocorrelation;
mod case;
mod grid;
pub mod options;
mod report;
mod weights;

use crate::{check_minds::parameters, error::LabError, fit_events::KeptFigures, folds};
use case::{EventEvidence, INTENTS, InferenceCase};
use grid::Grid;
use options::FitInference;
use phase_cli::{
    context::Context,
    interrupt,
    output::{json_text, print_result},
};
use phase_event::Recording;
use phase_model::AGENT_COUNT;
use phase_runs::{error::RunError, words};
use phase_simple::{
    Algorithm, AlternativeAgents, ImaginedAgents, InferenceSettings, IntentNetwork, InversePlanningSettings,
};
use report::{Fold, InferenceFitReport};
use std::sync::Arc;
use weights::Weights;

/// Runs the command.
///
/// # Errors
/// Any [`LabError`] about the files, or an interruption.
pub fn run(arguments: &FitInference, context: &Context) -> Result<(), LabError> {
    let files = &arguments.events;
    files.check_out(&arguments.parameters)?;
    let settings = settings(arguments)?;
    let recordings = files.read_all(&files.events, context)?;
    let own = recordings.len();
    let folds = usize::from(arguments.folds);
    if own < folds {
        let rule = format!("--events: {}, fewer than --folds {folds}", words::events(own));
        return Err(RunError::Usage(rule).into());
    }
    let mut held_out = Vec::new();
    for file in &files.held_out {
        held_out.push((file.display().to_string(), files.read(file, context)?));
    }
    interrupt::listen();
    let planning = planning(arguments, &settings);
    let present = Weights::of(&settings, &planning);
    let kinds: Vec<ImaginedAgents> =
        core::iter::once(settings.agents).chain(settings.alternative.map(|it| it.agents)).collect();
    let network = Arc::new(IntentNetwork::bundled().map_err(LabError::IntentNetwork)?);
    let made_by = format!("{} {}", json_text(&kinds, "the minds")?, planning.interval);
    let kept = KeptFigures::new(&made_by, files, context)?;
    let evidence = |recordings: Vec<Recording>| -> Result<Vec<InferenceCase>, LabError> {
        let all: Vec<&Recording> = recordings.iter().collect();
        let found = kept.of(
            "simulating the intents",
            &all,
            kinds.len() * INTENTS * AGENT_COUNT,
            |recording, tick| EventEvidence::of(recording, &kinds, &planning, &network, files.seed, tick),
        )?;
        let cases = recordings.iter().zip(found);
        cases.map(|(recording, found)| Ok(InferenceCase::new(recording, found)?)).collect()
    };
    let cases = evidence(recordings)?;
    let grid = Grid::of(&cases, &present);
    let mut others = Vec::with_capacity(held_out.len());
    for (file, recordings) in held_out {
        others.push((file, Grid::of(&evidence(recordings)?, &present)));
    }
    let named: Vec<_> = grid.events().collect();
    let fold_of = folds::assign(&named, folds, files.seed);
    let fold = |fold| {
        let (validation, training): (Vec<usize>, Vec<usize>) = (0..own).partition(|&k| fold_of[k] == fold);
        Fold { weights: grid.fit(&training), validation }
    };
    let all: Vec<usize> = (0..own).collect();
    let report = InferenceFitReport {
        folds: (0..folds).map(fold).collect(),
        fitted: grid.fit(&all),
        autocorrelation_time: autocorrelation::time(&cases, &present),
        present,
        grid: &grid,
        held_out: &others,
    };
    files.write(&report.fitted)?;
    print_result(report.text().trim_end())?;
    Ok(())
}

/// SIMPLE's settings with the minds that were asked for: both kinds, unless one was named or given.
fn settings(arguments: &FitInference) -> Result<InferenceSettings, RunError> {
    let one = InferenceSettings::default();
    let given = arguments.parameters.as_deref().map(parameters::read).transpose()?;
    let mut settings = match (given, arguments.minds) {
        (Some(minds), _) => {
            let agents = ImaginedAgents::searching(minds.kind());
            one.with_agents(agents.with_minds(minds.with_simulations(agents.minds.simulations())))
        }
        (None, Some(kind)) => one.with_agents(ImaginedAgents::of(kind)),
        (None, None) => InferenceSettings::averaged(),
    };
    if let Some(simulations) = arguments.simulations {
        let searching =
            |agents: ImaginedAgents| agents.with_minds(agents.minds.with_simulations(simulations as usize));
        settings.agents = searching(settings.agents);
        let alternative = settings.alternative;
        settings.alternative = alternative.map(|it| AlternativeAgents { agents: searching(it.agents), ..it });
    }
    Ok(settings)
}

/// Settings of inverse planning, by which choices of minds are weighed.
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
