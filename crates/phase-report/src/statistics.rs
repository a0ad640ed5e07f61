//! The paper's figures about its dataset (section "Dataset Statistics") compared with those of another.

use phase_dataset::{
    labels::goal_counts,
    manifest::Manifest,
    splits::{self, Split},
};
use phase_model::{EventKind, Level, Relation, arena::STEP_VIDEO_SECONDS};
use std::collections::{BTreeMap, BTreeSet};

/// The composition of a dataset.
#[derive(Clone, PartialEq, Debug)]
pub struct Statistics {
    /// Number of events.
    pub events: usize,
    /// Number of events of each length (steps).
    pub lengths: BTreeMap<usize, usize>,
    /// Number of agents with each goal; see [`phase_dataset::labels::goal_label`].
    pub goals: BTreeMap<String, usize>,
    /// Number of events that show each relation.
    pub relations: BTreeMap<Relation, usize>,
    /// Number of events of each kind.
    pub kinds: BTreeMap<EventKind, usize>,
    /// Number of agents that do not know the other's goal, by level of reasoning.
    pub levels: BTreeMap<Level, usize>,
    /// Number of different layouts.
    pub layouts: usize,
    /// Number of events in each part, and numbers of test events in unseen layouts and of a type of their
    /// own; `None` if some event is in no part.
    pub parts: Option<[usize; 5]>,
}

/// One figure of a dataset.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct StatisticsRow {
    /// The name of the figure, in words.
    pub what: &'static str,
    /// The paper's value.
    pub paper: &'static str,
    /// The value for this dataset.
    pub ours: String,
}

impl Statistics {
    /// The composition of a dataset.
    #[must_use]
    pub fn of(manifest: &Manifest) -> Self {
        let events = &manifest.events;
        let agents = events.iter().flat_map(|event| &event.agents).map(|agent| (agent.goal, agent.alpha));
        let layouts: BTreeSet<(u8, Option<u8>)> =
            events.iter().map(|event| (event.layout.base, event.layout.flip)).collect();
        let parts: Option<Vec<Split>> = events.iter().map(|event| event.split).collect();
        let parts = parts.filter(|parts| !parts.is_empty());
        let parts = parts.and_then(|parts| {
            let found: Vec<usize> =
                splits::check(&manifest.items(), &parts).iter().map(|rule| rule.found).collect();
            found.try_into().ok()
        });
        Self {
            events: events.len(),
            lengths: counts(events.iter().map(|event| event.steps)),
            goals: goal_counts(agents),
            relations: counts(events.iter().map(|event| event.relation)),
            kinds: counts(events.iter().map(|event| event.kind)),
            levels: counts(events.iter().flat_map(|event| &event.agents).filter_map(|agent| agent.level)),
            layouts: layouts.len(),
            parts,
        }
    }

    /// All figures of the paper with the measured ones.
    #[must_use]
    pub fn figures(&self) -> Vec<StatisticsRow> {
        let figure = |what, paper, ours: String| StatisticsRow { what, paper, ours };
        let seconds = |steps: Option<(&usize, &usize)>| {
            steps.map_or_else(|| "–".into(), |(&steps, _)| format!("{} s", steps as f64 * STEP_VIDEO_SECONDS))
        };
        let relation = |relation| self.relations.get(&relation).copied().unwrap_or_default().to_string();
        let part = |k: usize| self.parts.map_or_else(|| "–".into(), |parts| parts[k].to_string());
        let goal = |count: Option<&usize>| count.copied().unwrap_or_default().to_string();
        vec![
            figure("videos", "500", self.events.to_string()),
            figure("shortest", "10 s", seconds(self.lengths.first_key_value())),
            figure("longest", "25 s", seconds(self.lengths.last_key_value())),
            figure("examples of the rarest goal", "47", goal(self.goals.values().min())),
            figure("examples of the most frequent goal", "129", goal(self.goals.values().max())),
            figure("friendly", "200", relation(Relation::Friendly)),
            figure("adversarial", "192", relation(Relation::Adversarial)),
            figure("neutral", "108", relation(Relation::Neutral)),
            figure("train", "320", part(0)),
            figure("validation", "80", part(1)),
            figure("test", "100", part(2)),
            figure("test in layouts seen nowhere else", "80", part(3)),
            figure("test of interaction types seen nowhere else", "9", part(4)),
            figure("layouts", "90 to draw from", self.layouts.to_string()),
        ]
    }
}

/// The figures as a table in Markdown.
#[must_use]
pub fn table(figures: &[StatisticsRow]) -> String {
    let mut text = String::from("| figure | paper | here |\n|---|---|---|\n");
    for StatisticsRow { what, paper, ours } in figures {
        text += &format!("| {what} | {paper} | {ours} |\n");
    }
    text
}

fn counts<T: Ord>(things: impl Iterator<Item = T>) -> BTreeMap<T, usize> {
    let mut counts = BTreeMap::new();
    for thing in things {
        *counts.entry(thing).or_default() += 1;
    }
    counts
}
