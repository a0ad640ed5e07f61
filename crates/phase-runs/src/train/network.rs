//! Training a baseline network round by round, so that the same command resumes after an interruption.

use super::{Trained, Training, events::Events, training_files::TrainingFiles};
use crate::{
    error::{RunError, train::TrainError},
    listener::Listener,
    parallel::{make_all, threads},
};
use phase_baselines::training::{
    Final, Metrics, NamedMetrics, NetworkError, PublishedNetwork, Round, TrainingRun, TrainingSettings,
    evaluate, to_safetensors,
};
use phase_dataset::splits::Split;
use phase_event::{ObservedEvent, Recording};
use phase_files::atomic;
use serde_json::json;

/// Trains a network on the samples that `sample` makes of events.
pub(super) fn run<N: PublishedNetwork>(
    options: &Training,
    listener: &dyn Listener,
    mut settings: TrainingSettings,
    sample: impl Fn(&Recording, &ObservedEvent) -> Result<N::Sample, TrainError> + Sync,
) -> Result<Trained, RunError>
where
    N::Sample: Send,
{
    settings.rounds = options.rounds.unwrap_or(settings.rounds);
    let events = Events::open(options)?;
    let samples = |split| -> Result<Vec<N::Sample>, RunError> {
        let recordings: Vec<Recording> = events.of(split)?.collect::<Result<_, _>>()?;
        let activity = format!("reading {} events", split.name());
        let progress = listener.progress(&activity, recordings.len(), 1);
        let made = make_all(threads(None), recordings.len(), |k| {
            let recording = &recordings[k];
            let id = || recording.id.clone();
            let observed =
                recording.observed().map_err(|source| TrainError::Observed { id: id(), source })?;
            let sample = sample(recording, &observed)?;
            progress.event(0, &recording.id);
            Ok(Some(sample))
        })?;
        made.ok_or_else(|| RunError::Interrupted(options.out.clone()))
    };
    events.check()?;
    let training = samples(Split::Train)?;
    let validation = samples(Split::Validation)?;
    let network = N::published(&mut TrainingRun::<N>::first_weights(options.seed)).map_err(failed)?;
    let mut run = TrainingRun::new(network, options.seed, settings);
    let sources = (events.source(Split::Train), events.source(Split::Validation));
    let mut training_files =
        TrainingFiles::open(&mut run, &options.out, sources.0, events.more_sources(), sources.1, listener)?;

    listener.note(&head(N::METRICS));
    run.rounds().iter().for_each(|round| listener.note(&line(round)));
    while !run.is_finished() {
        let seconds = training_files.round(&mut run, &training, &validation)?;
        let left = settings.rounds.saturating_sub(run.rounds().len()) as f64 * seconds / 60.0;
        let said = run.rounds().last().map_or_else(String::new, line);
        listener.note(&format!("{said}  {seconds:.1} s, at most {left:.0} min remaining"));
    }
    let best = run.best_round().map_or(0, |round| round.number);
    let network = run.into_best().map_err(failed)?;
    let report = |split: Split, samples: &[N::Sample]| -> Result<(NamedMetrics, String), RunError> {
        let evaluate = evaluate(&network, samples, settings.batch).map_err(failed)?;
        let scores: Vec<String> = evaluate.scores.iter().map(|score| format!("{score:.3}")).collect();
        let row = format!("| {} | {:.3} | {} |\n", split.name(), evaluate.loss, scores.join(" | "));
        Ok((NamedMetrics::of::<N>(&evaluate), row))
    };
    let (train, of_train) = report(Split::Train, &training)?;
    let (validation, of_validation) = report(Split::Validation, &validation)?;
    let test = if options.test { Some(report(Split::Test, &samples(Split::Test)?)?) } else { None };
    let (test, of_test) = test.unzip();
    let text = format!(
        "kept the weights of round {best}\n| events | loss | {} |\n|---|---|{}\n{of_train}{of_validation}{}",
        N::METRICS.join(" | "),
        "---|".repeat(N::METRICS.len()),
        of_test.unwrap_or_default(),
    );
    let finished = Final { train, validation, test };
    let place = phase_files::told(&options.out);
    let figures = json!({ "weights": place, "network": N::NAME, "best_round": best, "final": finished });
    let weights = to_safetensors(&network).map_err(TrainError::from)?;
    atomic::write(&options.out, &weights).map_err(TrainError::from)?;
    training_files.finish(finished)?;
    Ok(Trained { text, figures })
}

/// A failure of the neural-network library.
fn failed(error: impl Into<NetworkError>) -> TrainError {
    TrainError::Network(error.into())
}

fn head(scores: &[&str]) -> String {
    let columns: String = scores.iter().map(|score| format!(" {score:>9}")).collect();
    format!("round      train{columns}   validation{columns}")
}

fn line(round: &Round) -> String {
    let evaluate = |Metrics { loss, scores }: &Metrics| -> String {
        let scores: String = scores.iter().map(|score| format!(" {score:9.3}")).collect();
        format!("{loss:10.4}{scores}")
    };
    let star = if round.best { "*" } else { " " };
    format!("{:5} {} {:>12}{star}", round.number, evaluate(&round.training), evaluate(&round.validation))
}
