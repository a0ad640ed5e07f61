//! The report of all events, and by kind.

use super::{figures::MindFigures, measure::MeasuredEvent};
use phase_model::EventKind;
use phase_simple::choice::{Chance, fitted_lapse};
use serde::Serialize;
use serde_json::Value;

/// The value of the field `format` of reports.
const FORMAT: &str = "phase-minds/1";

/// The figures of all events, and of those of each kind.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub(super) struct MindsReport {
    format: &'static str,
    run: Value,
    /// The lapse rate at which all that was done is likeliest.
    pub(super) lapse: f64,
    /// All events.
    #[serde(flatten)]
    pub(super) overall: MindFigures,
    /// By name of the kind.
    #[serde(serialize_with = "as_object")]
    pub(super) kinds: Vec<(&'static str, MindFigures)>,
    each: Vec<EventReport>,
}

/// The figures of one event.
#[derive(Clone, PartialEq, Debug, Serialize)]
struct EventReport {
    id: String,
    kind: EventKind,
    #[serde(flatten)]
    figures: MindFigures,
}

impl MindsReport {
    /// The report of some events; `run` describes how it was made.
    pub(super) fn of(events: &[MeasuredEvent], run: Value) -> Self {
        let chances: Vec<Chance> = events.iter().flat_map(|event| event.chances.concat()).collect();
        let lapse = fitted_lapse(&chances);
        let kinds = EventKind::ALL.into_iter().filter_map(|kind| {
            let events: Vec<&MeasuredEvent> = events.iter().filter(|event| event.kind == kind).collect();
            (!events.is_empty()).then(|| (kind.name(), MindFigures::of(&events, lapse)))
        });
        let event = |event: &MeasuredEvent| EventReport {
            id: event.id.clone(),
            kind: event.kind,
            figures: MindFigures::of(&[event], lapse),
        };
        Self {
            format: FORMAT,
            run,
            lapse,
            overall: MindFigures::of(&events.iter().collect::<Vec<_>>(), lapse),
            kinds: kinds.collect(),
            each: events.iter().map(event).collect(),
        }
    }
}

fn as_object<S: serde::Serializer>(
    groups: &[(&'static str, MindFigures)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(groups.iter().map(|(name, figures)| (name, figures)))
}
