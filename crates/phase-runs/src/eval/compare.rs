//! Scores of one method less those of another, from the results of both.

use phase_eval::comparison::{ForecastDifference, GoalDifference};
use phase_model::json::read_as;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// The measures of each task that are compared, as results name them: of goals the shares of right goals and
/// relations, of trajectories the errors of agents (u).
pub const MEASURES: [(&str, [&str; 2]); 2] =
    [("goals", ["goal", "relation"]), ("trajectories", ["ade", "fde"])];

/// For each of the [`MEASURES`] of a task, the `value` of one method less that of another on the same events,
/// with the bounds `low` and `high` of a 95 % interval in which both are drawn together. Both are results of
/// `eval`; null without events. The seed is that of the intervals.
///
/// # Errors
/// A sentence, if one has no results of the task, or the events differ.
pub fn difference(task: &str, one: Value, other: Value, seed: u64) -> Result<Value, String> {
    if task == MEASURES[0].0 {
        let difference = GoalDifference::of(&events_of(one)?, &events_of(other)?, seed);
        value(difference.map_err(|error| error.to_string())?)
    } else {
        let difference = ForecastDifference::of(&events_of(one)?, &events_of(other)?, seed);
        value(difference.map_err(|error| error.to_string())?)
    }
}

fn value(difference: Option<impl serde::Serialize>) -> Result<Value, String> {
    serde_json::to_value(difference).map_err(|error| error.to_string())
}

fn events_of<E: DeserializeOwned>(mut results: Value) -> Result<Vec<E>, String> {
    let events = results.get_mut("events").map(Value::take).unwrap_or_default();
    read_as(events).map_err(|error| format!("results of another task, or none: {error}"))
}
