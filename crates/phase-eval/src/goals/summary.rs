//! Accuracy of a method over many events.

use super::{Agreement, Answer, Calibration, Label, RecognisedEvent, RoleScores, SetScores};
use crate::{Estimate, GroupScores};
use phase_model::{AGENT_COUNT, AgentId, EventKind, Relation};
use phase_statistics::mean;
use serde::{Deserialize, Serialize};

/// The relations in the order of the confusion matrix.
pub const RELATIONS: [Relation; 3] = [Relation::Friendly, Relation::Adversarial, Relation::Neutral];

/// Accuracies over some events.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct RecognitionScores {
    /// Number of events; each has two goals.
    pub n: usize,
    /// The correct goal is the most likely one.
    pub top1: Estimate,
    /// It is among the two most likely.
    pub top2: Estimate,
    /// It is among the three most likely.
    pub top3: Estimate,
    /// The most likely relation is the intended one.
    pub relation: Estimate,
    /// It is the one in human judgement, over the events that have one.
    pub relation_human: Option<Estimate>,
}

impl RecognitionScores {
    /// Scores some answers; `None` without any.
    fn of(answers: &[(&Answer, &Label)], seed: u64) -> Option<Self> {
        let top = |k: usize| {
            let right = answers.iter().map(|&(answer, label)| goals_among(answer, label, k));
            Estimate::of(&right.collect::<Vec<f64>>(), seed)
        };
        let related = |wanted: fn(&Label) -> Option<Relation>| {
            let right = |&(answer, label): &(&Answer, &Label)| Some(says(answer, wanted(label)?));
            Estimate::of(&answers.iter().filter_map(right).collect::<Vec<f64>>(), seed)
        };
        Some(Self {
            n: answers.len(),
            top1: top(1)?,
            top2: top(2)?,
            top3: top(3)?,
            relation: related(|label| Some(label.relation))?,
            relation_human: related(|label| label.relation_human),
        })
    }
}

/// The share of both agents whose correct goal is among the k most likely.
pub(crate) fn goals_among(answer: &Answer, label: &Label, k: usize) -> f64 {
    let among = |&agent: &AgentId| answer.place(agent, label.goals[agent]).is_some_and(|place| place < k);
    AgentId::ALL.into_iter().filter(among).count() as f64 / AGENT_COUNT as f64
}

/// 1 if this is the most likely relation, else 0.
pub(crate) fn says(answer: &Answer, relation: Relation) -> f64 {
    f64::from(u8::from(answer.relation.most_likely() == relation))
}

/// Accuracy of a method.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct RecognitionSummary {
    /// Over all events.
    pub all: RecognitionScores,
    /// By kind of event.
    pub kinds: Vec<GroupScores<RecognitionScores>>,
    /// In layouts that also occur in the training or validation events, and in others; empty where unknown.
    pub layouts: Vec<GroupScores<RecognitionScores>>,
    /// By length of the prefix, if requested. Events that end earlier are included as a whole.
    pub watched: Vec<GroupScores<RecognitionScores>>,
    /// By sets of events that differ in one social variable, if there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sets: Option<SetScores>,
    /// Scores of naming the agent that helps or hinders, if the method says.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roles: Option<RoleScores>,
    /// Scores of naming that agent, by kind of event.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub role_kinds: Vec<GroupScores<RoleScores>>,
    /// Agreement with people's ratings, of the events that were rated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub agreement: Option<Agreement>,
    /// Agreement of reports predicted by models that did not see the event's ratings, where the method's own
    /// model did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub held_out_agreement: Option<Agreement>,
    /// Agreement of the probabilities of relations with people's ratings, where the method predicts reports
    /// beside them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relation_agreement: Option<Agreement>,
    /// Confusion matrix of relations (number of events): `confusion[right][said]`, both in the order of
    /// [`RELATIONS`].
    pub confusion: [[usize; RELATIONS.len()]; RELATIONS.len()],
    /// Reliability of the most likely goals. An agent without a named goal counts as wrong with probability
    /// 0.
    pub goal_calibration: Calibration,
    /// Reliability of the most likely relations.
    pub relation_calibration: Calibration,
    /// CPU time for an event (s), the mean over those for which it was measured.
    pub cpu_seconds_per_event: Option<f64>,
}

impl RecognitionSummary {
    /// Aggregates the answers; `None` without events. The seed is that of the intervals.
    #[must_use]
    pub fn of(events: &[RecognisedEvent], seed: u64) -> Option<Self> {
        let group = |name: &str, chosen: &dyn Fn(&RecognisedEvent) -> bool| {
            let answers: Vec<(&Answer, &Label)> = events
                .iter()
                .filter(|event| chosen(event))
                .map(|event| (&event.answer, &event.label))
                .collect();
            Some(GroupScores { name: name.into(), scores: RecognitionScores::of(&answers, seed)? })
        };
        let kinds = EventKind::ALL.into_iter();
        let kinds = kinds.filter_map(|kind| group(kind.name(), &|event| event.label.kind == kind)).collect();
        let layouts = [("seen", true), ("unseen", false)].into_iter();
        let layouts = layouts
            .filter_map(|(name, seen)| group(name, &|event| event.label.layout_seen == Some(seen)))
            .collect();
        let cpu: Vec<f64> = events.iter().filter_map(|event| event.cpu_seconds).collect();
        Some(Self {
            all: group("all", &|_| true)?.scores,
            kinds,
            layouts,
            watched: watched(events, seed),
            sets: SetScores::of(events, seed),
            roles: RoleScores::of(events, seed),
            role_kinds: role_kinds(events, seed),
            agreement: Agreement::of(events, seed),
            held_out_agreement: None,
            relation_agreement: Agreement::of_relations(events, seed),
            confusion: confusion(events),
            goal_calibration: Calibration::of(&goal_answers(events)),
            relation_calibration: Calibration::of(&relation_answers(events)),
            cpu_seconds_per_event: mean(&cpu),
        })
    }
}

/// Scores of the answers to prefixes of events; the first event determines the prefixes.
fn watched(events: &[RecognisedEvent], seed: u64) -> Vec<GroupScores<RecognitionScores>> {
    let parts = events.first().map_or(0, |event| event.watched.len());
    let part = |k: usize| {
        let seconds = events.first()?.watched.get(k)?.seconds;
        let glimpses = events.iter().filter_map(|event| Some((&event.watched.get(k)?.answer, &event.label)));
        let scores = RecognitionScores::of(&glimpses.collect::<Vec<_>>(), seed)?;
        Some(GroupScores { name: format!("{seconds} s"), scores })
    };
    (0..parts).filter_map(part).collect()
}

/// Scores of roles by kind of event.
fn role_kinds(events: &[RecognisedEvent], seed: u64) -> Vec<GroupScores<RoleScores>> {
    let of_kind = |kind: EventKind| {
        let scores = RoleScores::of(events.iter().filter(|event| event.label.kind == kind), seed)?;
        Some(GroupScores { name: kind.name().into(), scores })
    };
    EventKind::ALL.into_iter().filter_map(of_kind).collect()
}

fn confusion(events: &[RecognisedEvent]) -> [[usize; RELATIONS.len()]; RELATIONS.len()] {
    let mut counts = [[0; RELATIONS.len()]; RELATIONS.len()];
    for event in events {
        let said = event.answer.relation.most_likely();
        for (row, right) in counts.iter_mut().zip(RELATIONS) {
            for (count, column) in row.iter_mut().zip(RELATIONS) {
                *count += usize::from(event.label.relation == right && said == column);
            }
        }
    }
    counts
}

fn goal_answers(events: &[RecognisedEvent]) -> Vec<(f64, bool)> {
    let of_agent = |event: &RecognisedEvent, agent: AgentId| {
        let p = event.answer.goals[agent].first().map_or(0.0, |share| share.p);
        (p, event.answer.place(agent, event.label.goals[agent]) == Some(0))
    };
    events
        .iter()
        .flat_map(|event| AgentId::ALL.into_iter().map(move |agent| of_agent(event, agent)))
        .collect()
}

fn relation_answers(events: &[RecognisedEvent]) -> Vec<(f64, bool)> {
    let of_event = |event: &RecognisedEvent| {
        let said = event.answer.relation.most_likely();
        (event.answer.relation.of(said), said == event.label.relation)
    };
    events.iter().map(of_event).collect()
}
