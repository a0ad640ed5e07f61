//! `fit-intents`: fits what SIMPLE takes neutral agents to know of the other's goal.
//!
//! Prior probabilities are compared on a grid by the mean Brier score of intents that agents take each other
//! to have, in events whose particles are known.

use crate::{error::LabError, fit_events::FitEvents};
use phase_cli::{context::Context, output::print_result};
use phase_eval::{
    beliefs::asked_steps,
    intents::{IntentEvent, IntentSummary},
};
use phase_event::{MethodError, ProgressCallback, Recording};
use phase_runs::{error::RunError, eval::TrueIntents};
use phase_simple::{IntentBeliefEvidence, Models, NeutralKnowledge, Simple};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The method whose answers are averages over what agents know.
const METHOD: &str = "simple-knowledge";
/// Prior probabilities of knowing the other's goal that are compared.
const KNOWS: [f64; 6] = [0.0, 0.25, 0.5, 0.75, 0.9, 1.0];
/// Shares of level 0 among agents that do not know it.
const LEVEL_ZERO: [f64; 3] = [0.0, 0.1, 1.0 / 3.0];

/// The evidence that an event gives about what its agents take each other to want, and what they do.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct KnownIntents {
    id: String,
    evidence: IntentBeliefEvidence,
    truth: TrueIntents,
}

/// Runs the command.
///
/// # Errors
/// Any [`LabError`] about the files, or an interruption.
pub fn run(arguments: &FitEvents, context: &Context) -> Result<(), LabError> {
    let models = Arc::new(Models::bundled().map_err(RunError::from)?);
    let Some(simple) = Simple::named(METHOD, &models) else {
        return Err(RunError::Usage(format!("{METHOD} is no method of this program")).into());
    };
    let compute = |recording: &Recording, tick: ProgressCallback<'_>| {
        known_intents(recording, &simple, arguments.seed, tick)
    };
    let activity = "reading what each takes the other to want";
    let [own, others] = arguments.of_simulated(activity, context, compute)?;
    let mut text = format!("{:>5} {:>7}{:>34}{:>34}\n", "", "", "fitted to", "held out");
    text += &format!("{:>5} {:>7}", "knows", "level 0");
    text += &format!("{:>10} {:>7} {:>7} {:>7}", "accuracy", "Brier", "ECE", "wrong").repeat(2);
    let mut fitted: Option<(f64, NeutralKnowledge)> = None;
    for knows in KNOWS {
        for level_zero in LEVEL_ZERO {
            let priors = NeutralKnowledge { knows, level_zero };
            let of_own = summary(&own, &priors, arguments.seed)?;
            let of_others = summary(&others, &priors, arguments.seed)?;
            let figures = [of_own.as_ref(), of_others.as_ref()].map(figures).concat();
            text += &format!("\n{knows:>5.2} {level_zero:>7.2}{figures}");
            let brier = of_own.and_then(|it| it.all).map_or(f64::INFINITY, |it| it.brier.value);
            if fitted.is_none_or(|(least, _)| brier < least) {
                fitted = Some((brier, priors));
            }
        }
    }
    if let Some((_, fitted)) = fitted {
        text += &format!("\nfitted: knows {}, level 0 {:.2}", fitted.knows, fitted.level_zero);
        arguments.write(&fitted)?;
    }
    print_result(&text)?;
    Ok(())
}

/// Accuracy, Brier score and calibration error of all beliefs, and the Brier score of mistaken ones.
fn figures(summary: Option<&IntentSummary>) -> String {
    let all = summary.and_then(|it| it.all.as_ref());
    let mistaken = summary.and_then(|it| it.mistaken.as_ref());
    let figure = |figure: Option<f64>| figure.map_or_else(|| "-".to_owned(), |it| format!("{it:.3}"));
    format!(
        "{:>10} {:>7} {:>7} {:>7}",
        figure(all.map(|it| it.accuracy.value)),
        figure(all.map(|it| it.brier.value)),
        figure(all.map(|it| it.calibration.error)),
        figure(mistaken.map(|it| it.brier.value))
    )
}

fn summary(
    events: &[KnownIntents],
    priors: &NeutralKnowledge,
    seed: u64,
) -> Result<Option<IntentSummary>, RunError> {
    let answered = |event: &KnownIntents| {
        let questions = event.truth.questions(&event.evidence.intents(priors));
        let questions = questions
            .map_err(|source| RunError::Method { id: event.id.clone(), source: MethodError::new(source) })?;
        let details = serde_json::Value::Null;
        Ok(IntentEvent { id: event.id.clone(), questions, cpu_seconds: None, details })
    };
    let events = events.iter().map(answered).collect::<Result<Vec<IntentEvent>, RunError>>()?;
    Ok(IntentSummary::of(&events, seed))
}

fn known_intents(
    recording: &Recording,
    simple: &Simple,
    seed: u64,
    tick: ProgressCallback<'_>,
) -> Result<Option<KnownIntents>, MethodError> {
    let observed = recording.observed().map_err(MethodError::new)?;
    let steps = asked_steps(observed.steps());
    let truth = TrueIntents::of(recording, &steps)?;
    let evidence = simple.intent_belief_evidence(&observed, &steps, seed, tick)?;
    Ok(evidence.map(|(evidence, _)| KnownIntents { id: recording.id.clone(), evidence, truth }))
}
