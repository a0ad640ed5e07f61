//! `fit-minds`: fits the parameters of the minds to events whose labels are known.
//!
//! The fit maximises how well the truth stands out: the log posterior of the true goals and attitudes among
//! all hypotheses. A mind that makes what was done likelier under every hypothesis alike would gain
//! likelihood and tell nobody's goals; the log likelihood under the truth is reported beside it. `case`
//! evaluates one event, `search` changes the parameters, and every fold of the events is held out of one fit.

mod ablation;
mod case;
mod evaluations;
mod means;
pub mod options;
mod parameter;
mod report;
mod search;

use crate::{check_minds, error::LabError, evaluations_file::EvaluationsFile, folds};
use ablation::Ablation;
use case::{Method, MindsCase};
use evaluations::Evaluations;
use options::FitMinds;
use parameter::{PARAMETERS, Parameter};
use phase_cli::{context::Context, interrupt, json_file, output::print_result};
use phase_event::{MethodError, ObservedEvent, Recording};
use phase_minds::{MindParameters, PhaseParameters};
use phase_runs::{error::RunError, parallel::make_all, words};
use search::Fit;
use std::path::Path;

/// Runs the command.
///
/// # Errors
/// Any [`LabError`] about the files, or an interruption.
pub fn run(arguments: &FitMinds, context: &Context) -> Result<(), LabError> {
    if let Some(out) = &arguments.out {
        let inputs = [Some(&arguments.events), arguments.generated.as_ref(), arguments.parameters.as_ref()];
        json_file::check("--out", out, inputs.into_iter().flatten())?;
        if out == Path::new("-") {
            return Err(RunError::Usage("--out -: a file is needed".into()).into());
        }
    }
    let start = start(arguments)?;
    let mut recordings = check_minds::recordings(&arguments.events, &[], None, context)?;
    let own = recordings.len();
    if !arguments.ablation && own < usize::from(arguments.folds) {
        let (file, folds) = (arguments.events.display(), arguments.folds);
        let rule = format!("{file}: has {}, fewer than --folds {folds}", words::events(own));
        return Err(RunError::Usage(rule).into());
    }
    if let Some(file) = &arguments.generated {
        recordings.extend(check_minds::recordings(file, &[], None, context)?);
    }
    let chosen = chosen(arguments, &start)?;
    interrupt::listen();
    let observed = observed(&recordings)?;
    let method = Method::new(arguments.thin.into(), arguments.simulations as usize, arguments.seed);
    let cases = prepare(&recordings, &observed, method, start.particles, arguments, context)?;
    let kept = arguments.out.as_deref().map(EvaluationsFile::beside).transpose()?;
    let mut evaluations = Evaluations::new(&cases, method, kept, &arguments.jobs, context)?;
    let everything: Vec<usize> = (0..cases.len()).collect();
    let (events, held_out) = everything.split_at(own);
    if arguments.ablation {
        let ablation = Ablation::of(start, &chosen, &everything, method, &mut evaluations)?;
        arguments.out.as_deref().map_or(Ok(()), |out| json_file::write(out, &ablation))?;
        print_result(ablation.table().trim_end())?;
        return Ok(());
    }
    let mut fits = fits(&cases[..own], events, start, arguments);
    search::run(&mut fits, &chosen, arguments.rounds.into(), &mut evaluations, context)?;
    let text = report::of(&fits, start, &chosen, held_out, method, &mut evaluations)?;
    if let Some(all) = fits.last() {
        let fitted = MindParameters::from(all.parameters);
        arguments.out.as_deref().map_or(Ok(()), |out| json_file::write(out, &fitted))?;
    }
    print_result(text.trim_end())?;
    Ok(())
}

/// The parameters that a fit starts from.
fn start(arguments: &FitMinds) -> Result<PhaseParameters, RunError> {
    let Some(file) = &arguments.parameters else { return Ok(PhaseParameters::default()) };
    match check_minds::parameters::read(file)? {
        MindParameters::Phase(parameters) => Ok(parameters),
        MindParameters::Published(_) => {
            let rule = "the parameters of published minds are not fitted";
            Err(RunError::Usage(format!("{}: {rule}", file.display())))
        }
    }
}

/// The parameters to be changed.
///
/// # Errors
/// If one of them starts from a value that it may not have.
fn chosen(arguments: &FitMinds, start: &PhaseParameters) -> Result<Vec<&'static Parameter>, RunError> {
    let wanted =
        |it: &&Parameter| arguments.only.is_empty() || arguments.only.iter().any(|name| name == it.name);
    let chosen: Vec<&'static Parameter> = PARAMETERS.iter().filter(wanted).collect();
    for parameter in &chosen {
        let (low, high) = parameter.range();
        let value = parameter.value(start);
        if !(low..=high).contains(&value) {
            let name = parameter.name;
            let file =
                arguments.parameters.as_ref().map_or_else(String::new, |it| format!("{}: ", it.display()));
            let rule = format!("{file}field `{name}` is {value}, but must be from {low} to {high}");
            return Err(RunError::Usage(rule));
        }
    }
    Ok(chosen)
}

/// Prepares what an observer sees of each event.
fn observed(recordings: &[Recording]) -> Result<Vec<ObservedEvent>, RunError> {
    let one = |recording: &Recording| {
        let failed = |error| RunError::Method { id: recording.id.clone(), source: MethodError::new(error) };
        recording.observed().map_err(failed)
    };
    recordings.iter().map(one).collect()
}

/// Everything that does not depend on the parameters.
fn prepare<'a>(
    recordings: &'a [Recording],
    observed: &'a [ObservedEvent],
    method: Method,
    particles: usize,
    arguments: &FitMinds,
    context: &Context,
) -> Result<Vec<MindsCase<'a>>, LabError> {
    let activity = format!("preparing {}", words::events(recordings.len()));
    let progress = context.progress_over(&activity, recordings.len());
    let cases = make_all(arguments.jobs.threads(), recordings.len(), |k| {
        let case = MindsCase::new(&recordings[k], &observed[k], method, particles)?;
        progress.step();
        Ok(Some(case))
    })?;
    cases.ok_or(LabError::Interrupted)
}

/// One fit without each fold, and at last one on all events.
fn fits(cases: &[MindsCase<'_>], events: &[usize], start: PhaseParameters, arguments: &FitMinds) -> Vec<Fit> {
    let folds = usize::from(arguments.folds);
    let named: Vec<_> = cases.iter().map(|case| (case.id, case.kind)).collect();
    let fold_of = folds::assign(&named, folds, arguments.seed);
    let mut fits: Vec<Fit> = (0..folds)
        .map(|fold| {
            let (validation, training) = events.iter().partition(|&&event| fold_of[event] == fold);
            Fit::new(format!("fold {}", fold + 1), start, training, validation)
        })
        .collect();
    fits.push(Fit::new("all".into(), start, events.to_vec(), Vec::new()));
    fits
}
