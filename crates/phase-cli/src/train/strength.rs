//! `strength`: trains SIMPLE's guess at the agents' strengths and says how good it is.

use super::{error::TrainError, events::Events, options::Options};
use crate::console::{remark, tell};
use phase_baselines::strength::{Motion, Sample, Score, Settings, commonest, score, train};
use phase_dataset::{atomic::AtomicFile, splits::Split};
use phase_model::Strength;
use phase_simple::StrengthRegressor;
use std::io::Write;

/// Runs the command.
///
/// # Errors
/// If the dataset cannot be used, nothing can be learnt or the file cannot be written.
pub(super) fn run(options: &Options) -> Result<(), TrainError> {
    let events = Events::open(options)?;
    // Where nothing can be written is to be known before the work.
    let mut file = AtomicFile::create(&options.out)?;
    let training = motions(&events, Split::Train)?;
    let validation = motions(&events, Split::Validation)?;
    remark("epoch  train  validation: whole  windows  together (RMSE in N)");
    let regressor = train(&training, &validation, options.seed, &Settings::default(), &mut |epoch| {
        remark(format!(
            "{:5} {:6.1} {:18.1} {:8.1} {:9.1}{}",
            epoch.number,
            epoch.training,
            epoch.whole,
            epoch.windows,
            epoch.validation,
            if epoch.best { " *" } else { "" },
        ));
    })?;
    file.write_all(&regressor.to_safetensors()?).map_err(|source| file.failed(source))?;
    file.commit()?;

    let guess = commonest(training.iter().map(|motion| &motion.whole));
    tell(
        "| events | motion | RMSE (N) | RMSE of a constant (N) | nearest level right | commonest level right |",
    );
    tell("|---|---|---|---|---|---|");
    report(&regressor, Split::Train, &training, guess);
    report(&regressor, Split::Validation, &validation, guess);
    if options.test {
        report(&regressor, Split::Test, &motions(&events, Split::Test)?, guess);
    }
    Ok(())
}

fn motions(events: &Events, split: Split) -> Result<Vec<Motion>, TrainError> {
    let mut motions = Vec::new();
    for recording in events.of(split)? {
        let recording = recording?;
        let observed = recording
            .observed()
            .map_err(|source| TrainError::Observed { id: recording.id.clone(), source })?;
        motions.extend(Motion::of_event(&observed, recording.scene.agents.map(|agent| agent.strength)));
    }
    Ok(motions)
}

fn report(regressor: &StrengthRegressor, split: Split, motions: &[Motion], guess: Strength) {
    let whole: Vec<&[Sample]> = motions.iter().map(|motion| core::slice::from_ref(&motion.whole)).collect();
    let windows = motions.iter().map(|motion| &*motion.windows).collect();
    for (name, groups) in [("whole events", whole), ("windows of 10 steps", windows)] {
        let Score { rmse, rmse_of_constant, accuracy, accuracy_of_guess } = score(regressor, groups, guess);
        tell(format!(
            "| {} | {name} | {rmse:.1} | {rmse_of_constant:.1} | {:.1} % | {:.1} % |",
            split.name(),
            100.0 * accuracy,
            100.0 * accuracy_of_guess,
        ));
    }
}
