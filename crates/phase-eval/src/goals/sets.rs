//! Accuracy by sets of events that differ in one social variable.

use super::RecognisedEvent;
use crate::Estimate;
use phase_model::AgentId;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Shares of sets all of whose events are recognised. A method that overlooks the one difference, and
/// answers as most events with the same scene and the same goal of the other agent would have it, is never
/// right about a whole set.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct SetScores {
    /// Number of sets.
    pub n: usize,
    /// The most likely relations are the intended ones.
    pub relation: Estimate,
    /// The most likely goals of both agents are correct.
    pub goals: Estimate,
    /// Both.
    pub all: Estimate,
}

impl SetScores {
    /// Scores the events that belong to sets; `None` if none does. The seed is that of the intervals.
    #[must_use]
    pub fn of(events: &[RecognisedEvent], seed: u64) -> Option<Self> {
        let mut sets: BTreeMap<&str, [bool; 2]> = BTreeMap::new();
        for event in events {
            let (Some(set), answer, label) = (event.label.set.as_deref(), &event.answer, &event.label) else {
                continue;
            };
            let [relation, goals] = sets.entry(set).or_insert([true; 2]);
            *relation &= answer.relation.most_likely() == label.relation;
            *goals &=
                AgentId::ALL.into_iter().all(|agent| answer.place(agent, label.goals[agent]) == Some(0));
        }
        let share = |right: fn(&[bool; 2]) -> bool| {
            let values: Vec<f64> = sets.values().map(|set| f64::from(u8::from(right(set)))).collect();
            Estimate::of(&values, seed)
        };
        Some(Self {
            n: sets.len(),
            relation: share(|set| set[0])?,
            goals: share(|set| set[1])?,
            all: share(|set| set[0] && set[1])?,
        })
    }
}
