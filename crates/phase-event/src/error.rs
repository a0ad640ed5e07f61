//! Errors in events, each displayed as one plain sentence.

use phase_model::{
    AGENT_COUNT, MAX_OBJECTS, SceneError,
    json::{FieldError, JsonError},
};
use thiserror::Error;

/// Why a text is not `phase-events/1`, or an event of it cannot be used.
#[derive(Clone, PartialEq, Debug, Error)]
pub enum EventReadError {
    /// It is not JSON, or JSON of another format.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// It contains no events.
    #[error("field `events` must hold at least one event")]
    NoEvents,
    /// Two events have the same id, or ids that differ in case only.
    #[error("event {0}: field `id` must differ from that of every other event, and not in case alone")]
    DuplicateId(String),
    /// A field violates a rule.
    #[error("{}{problem}", event_prefix(event))]
    Field {
        /// The event it belongs to, by its `id` or its number; `None` if it belongs to none, or to the only
        /// one.
        event: Option<String>,
        /// The field and the rule.
        #[source]
        problem: FieldError,
    },
    /// The scene violates a rule of [`phase_model::validate`].
    #[error("{}{}", event_prefix(event), in_trajectory(&source.to_string()))]
    Scene {
        /// The event's `id`; `None` if it has none.
        event: Option<String>,
        /// The rule.
        source: SceneError,
    },
}

/// Why events cannot be written.
#[derive(Debug, Error)]
pub enum EventWriteError {
    /// An event contains a number that JSON cannot express.
    #[error("event {0} holds a number that is not finite and cannot be written")]
    NotFinite(String),
    /// An event cannot be serialised for another reason.
    #[error("event {event} cannot be written: {source}")]
    Json {
        /// The event's `id`.
        event: String,
        /// The reason.
        source: serde_json::Error,
    },
}

fn event_prefix(event: &Option<String>) -> String {
    event.as_ref().map_or_else(String::new, |event| format!("event {event}: "))
}

/// The scene's checks refer to a start pose where an event has the first row of a trajectory.
pub(crate) fn in_trajectory(rule: &str) -> String {
    ["agents", "objects"].into_iter().fold(rule.to_owned(), |rule, group| {
        (0..MAX_OBJECTS.max(AGENT_COUNT)).fold(rule, |rule, k| {
            rule.replace(&format!("{group}[{k}].start"), &format!("trajectory.{group}[{k}][0]"))
        })
    })
}
