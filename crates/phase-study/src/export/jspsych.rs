//! Answers of people to the jsPsych plugin `phase-rating`, as `phase-ratings/1`.

use super::{RELATIONS, document_of};
use crate::forms::{Form, RELATION};
use phase_eval::ratings::RatingCounts;
use phase_model::foreign;
use phase_model::json::{Field, FieldError, JsonError, parse_text};
use serde_json::Value;
use std::collections::BTreeMap;
use thiserror::Error;

/// The plugin whose trials are read.
const PLUGIN: &str = "phase-rating";

/// Why a file of jsPsych cannot be used.
#[derive(Clone, PartialEq, Debug, Error)]
pub enum JsPsychError {
    /// Neither JSON nor, because of the first column, CSV.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// Not a table of comma-separated values.
    #[error("is no table of comma-separated values: {0}")]
    Csv(String),
    /// A trial lacks something, or has something else there.
    #[error("trial {number}: {problem}")]
    Trial {
        /// Its number among the participant's trials, from 1.
        number: usize,
        /// The broken rule.
        problem: FieldError,
    },
    /// One person rated an event twice.
    #[error("trial {number}: rates the event {event:?} a second time")]
    Again {
        /// Its number among the participant's trials, from 1.
        number: usize,
        /// The event.
        event: String,
    },
    /// A participant rated no relation.
    #[error("has no trial of the plugin {PLUGIN} that asks for a relation")]
    Unrated,
}

/// The answers of one person.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Participant {
    /// By event the relation, as the count of one rater.
    pub relations: BTreeMap<String, RatingCounts>,
    /// Catch trials that were failed.
    pub failures: usize,
}

/// The participants of a file that `jsPsych.data` made: JSON or CSV of one person, or an array of JSON for
/// each in a line of its own, as JATOS exports them. Trials of other plugins are left out, and of catch
/// trials (`correct` is not null) only those that were failed count.
///
/// # Errors
/// [`JsPsychError`].
pub fn participants(text: &str) -> Result<Vec<Participant>, JsPsychError> {
    let text = text.trim_start_matches('\u{feff}').trim();
    if !text.starts_with(['[', '{']) && !text.is_empty() {
        return Ok(vec![participant(&table(text)?)?]);
    }
    let whole = |line: &&str| line.trim_start().starts_with('[') && line.trim_end().ends_with(']');
    let lines: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).collect();
    if lines.len() > 1 && lines.iter().all(whole) {
        return lines.into_iter().map(|line| participant(&parse_text(line)?)).collect();
    }
    Ok(vec![participant(&parse_text(text)?)?])
}

/// Counts of what these participants called each event, as `phase-ratings/1`. Those who failed more catch
/// trials than allowed do not count.
#[must_use]
pub fn ratings_of(participants: &[Participant], failures_allowed: usize) -> Value {
    let mut counts = BTreeMap::<&str, RatingCounts>::new();
    for participant in participants.iter().filter(|one| one.failures <= failures_allowed) {
        for (event, one) in &participant.relations {
            *counts.entry(event).or_default() += *one;
        }
    }
    document_of(&counts)
}

fn participant(trials: &Value) -> Result<Participant, JsPsychError> {
    let mut participant = Participant::default();
    let trials = Field::root(trials).items().map_err(|problem| JsPsychError::Trial { number: 1, problem })?;
    for (trial, number) in trials.zip(1..) {
        let Some((event, relation)) = read(&trial, &mut participant.failures)
            .map_err(|problem| JsPsychError::Trial { number, problem })?
        else {
            continue;
        };
        if participant.relations.insert(event.into(), relation).is_some() {
            return Err(JsPsychError::Again { number, event: event.into() });
        }
    }
    if participant.relations.is_empty() { Err(JsPsychError::Unrated) } else { Ok(participant) }
}

/// The event and the relation that a trial gives it, if it does.
fn read<'a>(trial: &Field<'a>, failures: &mut usize) -> Result<Option<(&'a str, RatingCounts)>, FieldError> {
    if trial.optional("trial_type")?.is_none_or(|plugin| *plugin.value() != *PLUGIN) {
        return Ok(None);
    }
    if let Some(correct) = trial.optional("correct")? {
        let passed = correct.value().as_bool().ok_or_else(|| correct.must_be("true, false or null"))?;
        *failures += usize::from(!passed);
        return Ok(None);
    }
    let forms = Form::ALL.map(|form| (form.name(), form));
    if trial.required("form")?.one_of(&forms)? == Form::Interactions {
        return Ok(None);
    }
    let event = trial.required("event")?.text()?;
    let relation = trial.required("response")?.required(RELATION)?.one_of(&RELATIONS)?;
    Ok(Some((event, relation)))
}

/// The rows of a table as objects. Texts that are JSON for `response` and `correct` are read as such.
fn table(text: &str) -> Result<Value, JsPsychError> {
    let csv = |error: csv::Error| JsPsychError::Csv(foreign::table(&error.to_string()));
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().map_err(csv)?.clone();
    if let Some(missing) = ["trial_type", "form", "event", "response", "correct"]
        .into_iter()
        .find(|name| header.iter().filter(|column| column == name).count() != 1)
    {
        return Err(JsPsychError::Csv(format!("it needs one column `{missing}`")));
    }
    let mut trials = Vec::new();
    for (row, number) in reader.records().zip(1..) {
        let row = row.map_err(csv)?;
        let cells = header.iter().zip(&row).filter(|(_, cell)| !cell.is_empty());
        let mut trial = serde_json::Map::new();
        let is_ours = header.iter().zip(&row).any(|(name, cell)| name == "trial_type" && cell == PLUGIN);
        for (name, cell) in cells.filter(|_| is_ours) {
            let value = match name {
                "response" | "correct" => parse_text(cell).map_err(|error| JsPsychError::Trial {
                    number,
                    problem: FieldError { field: name.into(), rule: error.to_string() },
                })?,
                _ => cell.into(),
            };
            trial.insert(name.into(), value);
        }
        trials.push(trial.into());
    }
    Ok(Value::Array(trials))
}
