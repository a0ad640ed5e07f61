//! `strength`: trains the strength regressor of SIMPLE and evaluates it.

use super::{Trained, Training, events::Events};
use crate::{
    error::{RunError, train::TrainError},
    listener::Listener,
};
use phase_baselines::strength::{
    AgentSamples, Sample, Score, StrengthTrainingSettings, most_common, score, train,
};
use phase_dataset::splits::Split;
use phase_files::atomic::AtomicFile;
use phase_model::Strength;
use phase_simple::StrengthRegressor;
use serde::Serialize;
use serde_json::json;
use std::io::Write;

/// Trains and evaluates it.
pub(super) fn run(options: &Training, listener: &dyn Listener) -> Result<Trained, RunError> {
    let events = Events::open(options)?;
    // An unwritable output is detected before the work.
    let mut file = AtomicFile::create(&options.out).map_err(TrainError::from)?;
    events.check()?;
    listener.note("reading the events");
    let training = motions(&events, Split::Train)?;
    let validation = motions(&events, Split::Validation)?;
    listener.note("epoch  train  validation: whole  windows  together (RMSE in N)");
    let regressor =
        train(&training, &validation, options.seed, &StrengthTrainingSettings::default(), &mut |epoch| {
            listener.note(&format!(
                "{:5} {:6.1} {:18.1} {:8.1} {:9.1}{}",
                epoch.number,
                epoch.training,
                epoch.whole,
                epoch.windows,
                epoch.validation,
                if epoch.best { " *" } else { "" },
            ));
        })
        .map_err(TrainError::from)?;
    let weights = regressor.to_safetensors().map_err(TrainError::from)?;
    file.write_all(&weights).map_err(|source| TrainError::from(file.failed(source)))?;
    file.commit().map_err(TrainError::from)?;

    let guess = most_common(training.iter().map(|motion| &motion.whole));
    let mut rows = report(&regressor, Split::Train, &training, guess);
    rows.extend(report(&regressor, Split::Validation, &validation, guess));
    if options.test {
        rows.extend(report(&regressor, Split::Test, &motions(&events, Split::Test)?, guess));
    }
    let text = "| events | motion | RMSE (N) | RMSE of a constant (N) | nearest level right | commonest level right |\n\
        |---|---|---|---|---|---|\n"
        .to_owned();
    let lines = rows.iter().map(Row::line).collect::<String>();
    Ok(Trained {
        text: text + &lines,
        figures: json!({ "weights": phase_files::told(&options.out), "scores": rows }),
    })
}

/// Accuracy of the network on one part of the data.
#[derive(Serialize)]
struct Row {
    split: &'static str,
    motion: &'static str,
    rmse: f64,
    rmse_of_constant: f64,
    accuracy: f64,
    accuracy_of_commonest: f64,
}

impl Row {
    fn line(&self) -> String {
        let Self { split, motion, rmse, rmse_of_constant, accuracy, accuracy_of_commonest } = self;
        let accuracy = 100.0 * accuracy;
        let most_common = 100.0 * accuracy_of_commonest;
        format!(
            "| {split} | {motion} | {rmse:.1} | {rmse_of_constant:.1} | {accuracy:.1} % | {most_common:.1} % |\n"
        )
    }
}

fn motions(events: &Events, split: Split) -> Result<Vec<AgentSamples>, TrainError> {
    let mut motions = Vec::new();
    for recording in events.of(split)? {
        let recording = recording?;
        let observed = recording
            .observed()
            .map_err(|source| TrainError::Observed { id: recording.id.clone(), source })?;
        motions.extend(AgentSamples::of_event(&observed, recording.scene.agents.map(|agent| agent.strength)));
    }
    Ok(motions)
}

fn report(
    regressor: &StrengthRegressor,
    split: Split,
    motions: &[AgentSamples],
    guess: Strength,
) -> Vec<Row> {
    let whole: Vec<&[Sample]> = motions.iter().map(|motion| core::slice::from_ref(&motion.whole)).collect();
    let windows = motions.iter().map(|motion| &*motion.windows).collect();
    let row = |(motion, groups)| {
        let Score { rmse, rmse_of_constant, accuracy, accuracy_of_guess } = score(regressor, groups, guess);
        let split = split.name();
        let accuracy_of_commonest = accuracy_of_guess;
        Row { split, motion, rmse, rmse_of_constant, accuracy, accuracy_of_commonest }
    };
    [("whole events", whole), ("windows of 10 steps", windows)].map(row).into()
}
