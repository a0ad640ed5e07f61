//! The composition of a generated dataset.

use crate::{FileError, Problem, splits::Split};
use phase_model::{
    Layout, Relation,
    layout::USED_BASES,
    random::{self, Purpose},
};
use phase_sampler::Variant;
use serde::Deserialize;
use std::{
    collections::{BTreeMap, BTreeSet},
    path::Path,
};

/// The value of the field `format` of preset files.
pub const PRESET_FORMAT: &str = "phase-preset/2";

/// A recipe for a dataset.
#[derive(Clone, PartialEq, Eq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Preset {
    /// Always [`PRESET_FORMAT`].
    pub format: String,
    /// Name; the ids of events begin with it.
    pub name: String,
    /// Seed unless another is given.
    pub seed: u64,
    /// Names for sets of base layouts; each is used unchanged and in its four reflections.
    pub layouts: BTreeMap<String, Vec<u8>>,
    /// What an event has to satisfy; without it the first scene drawn is accepted.
    pub selection: Option<Selection>,
    /// What the dataset is composed of.
    pub groups: Vec<PresetGroup>,
}

/// Which events are accepted.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Selection {
    /// The shortest event (steps).
    pub min_steps: usize,
    /// The longest event (steps).
    pub max_steps: usize,
    /// Maximum number of scenes tried for an event before the run fails.
    pub attempts: usize,
    /// Whether adversarial events, which need not end on their own, end at a step uniformly sampled from
    /// `min_steps` to `max_steps`. Otherwise all of them last to the maximum, and their length reveals the
    /// relation.
    #[serde(default)]
    pub draw_ends: bool,
}

impl Selection {
    /// The step at which an event of this relation and seed ends at the latest, if that is sampled.
    #[must_use]
    pub fn sampled_end(&self, relation: Relation, seed: u64) -> Option<usize> {
        let ends = self.max_steps.saturating_sub(self.min_steps) as u64 + 1;
        // The range is so small that the remainder introduces no noticeable bias.
        let drawn = random::derive_seed(seed, Purpose::Length, 0) % ends;
        (self.draw_ends && relation == Relation::Adversarial).then_some(self.min_steps + drawn as usize)
    }
}

/// Events that have everything in common except their goals.
#[derive(Clone, PartialEq, Eq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PresetGroup {
    /// The variant, and with it the kind.
    pub variant: Variant,
    /// The part of the dataset, if it is divided.
    pub split: Option<Split>,
    /// One of the names in `layouts`.
    pub layouts: String,
    /// Number of events.
    pub events: usize,
}

/// What one event of a dataset is to be.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct EventSlot {
    /// The variant.
    pub variant: Variant,
    /// Index of the pair of goals; see [`Variant::goals`].
    pub goal_index: usize,
    /// The part of the dataset, if it is divided.
    pub split: Option<Split>,
    /// The name of its layouts.
    pub layouts: String,
}

/// The slots of a preset: its groups interleaved evenly, repeated for larger datasets. Goals rotate, so that
/// they stay balanced.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Composition {
    slots: Vec<EventSlot>,
    turns: BTreeMap<Variant, usize>,
}

impl Preset {
    /// Reads a preset from text; `name` refers to it in messages.
    ///
    /// # Errors
    /// If the text is not a preset, lists no events, or names layouts that do not exist.
    pub fn parse(name: &str, text: &str) -> Result<Self, FileError> {
        let what = "preset";
        let fail = |problem| FileError { file: Path::new(name).to_owned(), problem };
        let preset: Self =
            serde_json::from_str(text).map_err(|source| fail(Problem::Incomplete { what, source }))?;
        preset.check().map_err(|rule| fail(Problem::Shape { what, rule }))?;
        Ok(preset)
    }

    fn check(&self) -> Result<(), String> {
        if self.format != PRESET_FORMAT {
            return Err(format!("field `format` must be {PRESET_FORMAT:?}"));
        }
        let plain = |letter: char| letter.is_ascii_alphanumeric() || "-_.".contains(letter);
        if self.name.is_empty() || self.name.len() > 60 || !self.name.chars().all(plain) {
            return Err("field `name` must be 1 to 60 letters, digits, `-`, `_`, `.`".into());
        }
        if self.groups.is_empty() || self.groups.iter().any(|group| group.events == 0) {
            return Err("fields `groups` and `events` must not be empty".into());
        }
        for (name, bases) in &self.layouts {
            if let Some(base) = bases.iter().find(|base| !USED_BASES.contains(base)) {
                return Err(format!("layouts.{name} names base {base}, which no event is made in"));
            }
        }
        let empty = |group: &&PresetGroup| self.layouts.get(&group.layouts).is_none_or(Vec::is_empty);
        if let Some(group) = self.groups.iter().find(empty) {
            return Err(format!("there are no layouts of the name {:?}", group.layouts));
        }
        if self.selection.is_some_and(|it| it.attempts == 0 || it.min_steps > it.max_steps) {
            return Err("selection needs an attempt, and min_steps no greater than max_steps".into());
        }
        Ok(())
    }

    /// Default number of events.
    #[must_use]
    pub fn events(&self) -> usize {
        self.groups.iter().map(|group| group.events).sum()
    }

    /// The layouts of a name.
    #[must_use]
    pub fn pool(&self, name: &str) -> Vec<Layout> {
        let bases: BTreeSet<u8> = self.layouts.get(name).into_iter().flatten().copied().collect();
        Layout::all_used().filter(|layout| bases.contains(&layout.base())).collect()
    }

    /// The slots.
    #[must_use]
    pub fn composition(&self) -> Composition {
        // The place of event j of n is (2 j + 1) / 2 n of the way; equal places keep the groups' order.
        let places = self.groups.iter().flat_map(|group| (0..group.events).map(move |j| (j, group)));
        let mut places: Vec<(usize, &PresetGroup)> = places.collect();
        places.sort_by(|(a, one), (b, other)| ((2 * a + 1) * other.events).cmp(&((2 * b + 1) * one.events)));
        let mut turns: BTreeMap<Variant, usize> = BTreeMap::new();
        let slot = |(_, group): (usize, &PresetGroup)| {
            let next = turns.entry(group.variant).or_default();
            *next += 1;
            EventSlot {
                variant: group.variant,
                goal_index: *next - 1,
                split: group.split,
                layouts: group.layouts.clone(),
            }
        };
        let slots = places.into_iter().map(slot).collect();
        Composition { slots, turns }
    }

    /// The id of the event with this number.
    #[must_use]
    pub fn id(&self, index: usize) -> String {
        format!("{}-{index:04}", self.name)
    }
}

impl Composition {
    /// What the event with this number is to be.
    #[must_use]
    pub fn slot(&self, index: usize) -> EventSlot {
        let slot = &self.slots[index % self.slots.len()];
        let round = index / self.slots.len();
        let turns = self.turns.get(&slot.variant).copied().unwrap_or_default();
        EventSlot { goal_index: slot.goal_index + round * turns, ..slot.clone() }
    }
}
