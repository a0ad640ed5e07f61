//! The report of all events, by kind and by role.

use super::{
    figures::{Member, MindFigures},
    measure::MeasuredEvent,
    role::Role,
};
use phase_model::{AgentId, EventKind};
use phase_simple::choice::{Chance, fitted_lapse};
use serde::Serialize;
use serde_json::Value;

/// The value of the field `format` of reports.
const FORMAT: &str = "phase-minds/1";

/// The figures of all events, of those of each kind, and of the agents of each role.
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
    /// By name of the role.
    #[serde(serialize_with = "as_object")]
    pub(super) roles: Vec<(&'static str, MindFigures)>,
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
        let whole: Vec<Member<'_>> = events.iter().map(Member::whole).collect();
        let kinds = EventKind::ALL.into_iter().map(|kind| {
            let members = events.iter().filter(|event| event.kind == kind).map(Member::whole);
            (kind.name(), members.collect::<Vec<_>>())
        });
        let roles = Role::ALL.into_iter().map(|role| (role.name(), of_role(events, role)));
        let figures = |(name, members): (&'static str, Vec<Member<'_>>)| {
            (!members.is_empty()).then(|| (name, MindFigures::of(&members, lapse)))
        };
        let event = |event: &MeasuredEvent| EventReport {
            id: event.id.clone(),
            kind: event.kind,
            figures: MindFigures::of(&[Member::whole(event)], lapse),
        };
        Self {
            format: FORMAT,
            run,
            lapse,
            overall: MindFigures::of(&whole, lapse),
            kinds: kinds.filter_map(figures).collect(),
            roles: roles.filter_map(figures).collect(),
            each: events.iter().map(event).collect(),
        }
    }
}

fn of_role<'a>(events: &'a [MeasuredEvent], role: Role) -> Vec<Member<'a>> {
    let member = |event: &'a MeasuredEvent| {
        let agents = AgentId::ALL.into_iter().filter(|&agent| event.roles[agent] == role);
        let agents: Vec<AgentId> = agents.collect();
        (!agents.is_empty()).then_some(Member { event, agents })
    };
    events.iter().filter_map(member).collect()
}

fn as_object<S: serde::Serializer>(
    groups: &[(&'static str, MindFigures)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(groups.iter().map(|(name, figures)| (name, figures)))
}
