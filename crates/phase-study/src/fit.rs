//! Whether stored answers are some that a study can have been given. What does not fit would be left out of
//! exports and figures without a word.

use crate::{
    config::StudyConfig,
    forms::Forms,
    record::{LONGEST_RESPONSE, MOST_PLAYS, Millis, Rater, Trial},
};

/// The end of the year 2100 (ms since 1970).
const LATEST: Millis = 4_133_980_799_999;
/// Longest time that a clock may go back (ms): a day.
const LONGEST_BACK: Millis = 86_400_000;

/// A rater's number, and the rest of a sentence about them.
pub(crate) type Misfit = (u64, String);

/// Checks all raters against the configuration.
pub(crate) fn check(config: &StudyConfig, forms: &Forms, raters: &[Rater]) -> Result<(), Misfit> {
    raters.iter().try_for_each(|rater| one(config, forms, rater).map_err(|what| (rater.number, what)))
}

/// Checks one rater; the error is the rest of a sentence about it.
fn one(config: &StudyConfig, forms: &Forms, rater: &Rater) -> Result<(), String> {
    let pages = [rater.consented, rater.demographics.as_ref().map(|(at, _)| *at), rater.instructed];
    let times = rater.trials.iter().filter_map(|trial| trial.given.as_ref()).map(|given| given.at);
    let times: Vec<Millis> = times.chain(pages.into_iter().flatten()).collect();
    if times.iter().chain([&rater.joined]).any(|at| !(0..=LATEST).contains(at)) {
        return Err("has a time before 1970 or after 2100".into());
    }
    // A clock that is set may go back for a while.
    if times.iter().any(|at| at + LONGEST_BACK < rater.joined) {
        return Err("has answers from before they came".into());
    }
    let came_on = pages.iter().any(Option::is_some) || !rater.trials.is_empty();
    if rater.departure.is_some() && came_on {
        return Err("has left, and has answers".into());
    }
    if rater.consented.is_none() && came_on {
        return Err("has answers, and has not agreed to take part".into());
    }
    if let Some((_, answer)) = &rater.demographics {
        answer
            .check(&config.demographics)
            .map_err(|error| format!("has said about themselves what is not asked: {error}"))?;
    }
    let answered = rater.trials.iter().filter(|trial| trial.given.is_some()).count();
    if rater.trials.iter().take(answered).any(|trial| trial.given.is_none()) {
        return Err("has answered a trial before the one that comes before it".into());
    }
    if answered > 0 && rater.instructed.is_none() {
        return Err("has answers, and has not read the instructions".into());
    }
    for (k, shown) in rater.trials.iter().enumerate() {
        trial(config, forms, shown).map_err(|what| format!("in trial {}: {what}", k + 1))?;
    }
    Ok(())
}

fn trial(config: &StudyConfig, forms: &Forms, trial: &Trial) -> Result<(), String> {
    let shown = &trial.shown;
    if trial.catch && config.catch_trial(shown).is_none() {
        return Err(format!("the configuration has no catch trial {shown:?}"));
    }
    if !trial.catch && config.stimulus(shown).is_none() {
        return Err(format!("the configuration has no video {shown:?}"));
    }
    let Some(given) = &trial.given else { return Ok(()) };
    if !(0..=LONGEST_RESPONSE).contains(&given.response_time) {
        return Err(format!("response_time must be 0 to {LONGEST_RESPONSE} ms"));
    }
    if !(0..=MOST_PLAYS).contains(&given.plays) {
        return Err(format!("plays must be 0 to {MOST_PLAYS}"));
    }
    given.answer.check(&trial.questions(config, forms)).map_err(|error| error.to_string())
}
