//! `fit-beliefs`: fits how strongly SIMPLE takes what an agent does to tell what it knows of objects.
//!
//! The inverse temperatures of the likelihood of decisions are compared on a grid by the mean Brier score of
//! beliefs about entities out of sight, in events whose particles are known.

use crate::{error::LabError, fit_events::FitEvents};
use phase_cli::{context::Context, output::print_result};
use phase_eval::beliefs::{BeliefEvent, BeliefScores, BeliefSummary, asked_steps};
use phase_event::{BeliefOrder, MethodError, ProgressCallback, Recording};
use phase_runs::{error::RunError, eval::TrueBeliefs};
use phase_simple::{BeliefEvidence, KnowledgeSettings, Simple};
use serde::{Deserialize, Serialize};

/// Inverse temperatures that are compared. A sixth is that of the evidence about intents.
const INVERSE_TEMPERATURES: [f64; 8] = [1.0 / 6.0, 0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0];

/// The evidence that an event gives about its agents' beliefs, and these beliefs.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct KnownBeliefs {
    id: String,
    evidence: BeliefEvidence,
    truth: TrueBeliefs,
}

/// Runs the command.
///
/// # Errors
/// Any [`LabError`] about the files, or an interruption.
pub fn run(arguments: &FitEvents, context: &Context) -> Result<(), LabError> {
    let simple = Simple::bundled().map_err(RunError::from)?;
    let compute = |recording: &Recording, tick: ProgressCallback<'_>| {
        known_beliefs(recording, &simple, arguments.seed, tick)
    };
    let [own, others] = arguments.of_simulated("reading the beliefs", context, compute)?;
    let mut text = format!("{:>6}{:>34}{:>34}\n", "", "fitted to", "held out");
    text += &format!("{:>6}", "1/T");
    text += &format!("{:>10} {:>7} {:>7} {:>7}", "accuracy", "Brier", "ECE", "moved").repeat(2);
    let mut fitted: Option<(f64, KnowledgeSettings)> = None;
    for inverse_temperature in INVERSE_TEMPERATURES {
        let settings = KnowledgeSettings { inverse_temperature };
        let of_own = summary(&own, &settings, arguments.seed)?;
        let of_others = summary(&others, &settings, arguments.seed)?;
        text += &format!(
            "\n{inverse_temperature:>6.2}{}{}",
            figures(of_own.as_ref()),
            figures(of_others.as_ref())
        );
        let brier = of_own.and_then(|it| it.unseen).map_or(f64::INFINITY, |it| it.brier.value);
        if fitted.is_none_or(|(least, _)| brier < least) {
            fitted = Some((brier, settings));
        }
    }
    if let Some((_, fitted)) = fitted {
        text += &format!("\nfitted: {}", fitted.inverse_temperature);
        arguments.write(&fitted)?;
    }
    print_result(&text)?;
    Ok(())
}

/// Accuracy, Brier score and calibration error of what is not seen, and the last of what was moved unseen.
fn figures(summary: Option<&BeliefSummary>) -> String {
    let of = |scores: Option<&BeliefScores>, figure: fn(&BeliefScores) -> f64| {
        scores.map_or_else(|| "-".to_owned(), |scores| format!("{:.3}", figure(scores)))
    };
    let unseen = summary.and_then(|it| it.unseen.as_ref());
    let moved = summary.and_then(|it| it.moved.as_ref());
    format!(
        "{:>10} {:>7} {:>7} {:>7}",
        of(unseen, |it| it.accuracy.value),
        of(unseen, |it| it.brier.value),
        of(unseen, |it| it.calibration.error),
        of(moved, |it| it.calibration.error)
    )
}

fn summary(
    events: &[KnownBeliefs],
    settings: &KnowledgeSettings,
    seed: u64,
) -> Result<Option<BeliefSummary>, RunError> {
    let answered = |event: &KnownBeliefs| {
        let questions = event
            .truth
            .questions(&event.evidence.beliefs(settings))
            .map_err(|source| RunError::Method { id: event.id.clone(), source: MethodError::new(source) })?;
        Ok(BeliefEvent {
            id: event.id.clone(),
            order: BeliefOrder::First,
            questions,
            cpu_seconds: None,
            details: serde_json::Value::Null,
        })
    };
    let events = events.iter().map(answered).collect::<Result<Vec<BeliefEvent>, RunError>>()?;
    Ok(BeliefSummary::of(&events, seed))
}

fn known_beliefs(
    recording: &Recording,
    simple: &Simple,
    seed: u64,
    tick: ProgressCallback<'_>,
) -> Result<Option<KnownBeliefs>, MethodError> {
    let observed = recording.observed().map_err(MethodError::new)?;
    let steps = asked_steps(observed.steps());
    let truth = TrueBeliefs::of(recording, BeliefOrder::First, &steps)?;
    let evidence = simple.belief_evidence(&observed, BeliefOrder::First, &steps, seed, tick)?;
    Ok(evidence.map(|(evidence, _)| KnownBeliefs { id: recording.id.clone(), evidence, truth }))
}
