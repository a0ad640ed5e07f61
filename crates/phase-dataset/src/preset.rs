//! The composition of a generated dataset.

use crate::splits::Split;
use phase_event::check_id;
use phase_files::{FileError, Problem};
use phase_model::{
    Layout, Level, Relation,
    json::parse_as,
    layout::USED_BASES,
    random::{self, Purpose},
    setting::{EVENT_STEPS, EVENTS, RangeError, Setting},
};
use phase_sampler::{About, Stance, Variant};
use serde::Deserialize;
use serde_json::Value;
use std::{
    collections::{BTreeMap, BTreeSet},
    path::Path,
};

/// The value of the field `format` of preset files.
pub const PRESET_FORMAT: &str = "phase-preset/3";

/// Scenes that are tried for an event before a run gives up; a selection takes at most some hundreds.
const ATTEMPTS: Setting = Setting::whole("attempts", "", 1, 1_000_000);
/// Least length of an event.
const MIN_STEPS: Setting = Setting::whole("min_steps", "steps", 0, 10_000);

/// A recipe for a dataset, as `data/presets/NAME.json` has it (`phase-preset/3`).
///
/// It says how many events of which variants there are, in which layouts and splits, and which scenes are
/// accepted. With a seed it determines the dataset. The members of a file that may be absent are optional
/// here.
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
    /// Levels of reasoning of agents that do not know each other's goals: entry b is that of block b or, if
    /// there are no blocks, of event b of each variant; the list repeats. If it is empty, all agents know.
    #[serde(default)]
    pub levels: Vec<Level>,
    /// Parameters of the agents' minds that replace the defaults: an object as `--parameters` takes. Whoever
    /// makes minds checks it.
    pub minds: Option<Value>,
    /// Conditions that an event has to satisfy; without them the first scene drawn is accepted.
    pub selection: Option<Selection>,
    /// Composition of a dataset in which each event has bodies of its own.
    #[serde(default)]
    pub groups: Vec<PresetGroup>,
    /// Composition of a dataset in which events of several kinds share bodies.
    pub blocks: Option<Blocks>,
    /// Composition of a dataset of sets, whose events differ in one social variable. A preset has groups,
    /// blocks or sets.
    #[serde(default)]
    pub sets: Vec<SetGroup>,
}

/// Conditions under which an event is accepted.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Selection {
    /// The shortest event (steps).
    pub min_steps: usize,
    /// The longest event (steps).
    pub max_steps: usize,
    /// Maximum number of scenes tried for an event before the run fails.
    pub attempts: usize,
    /// Rule by which events end; [`Ends::Settled`] unless given.
    #[serde(default)]
    pub ends: Ends,
}

/// The rule by which the events of a dataset end.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ends {
    /// Once everything is settled; where that never happens, at the maximum length, so that length reveals
    /// the relation.
    #[default]
    Settled,
    /// As `Settled`, but adversarial events end at a step uniformly sampled from the minimum to the maximum
    /// at the latest.
    AdversarialDrawn,
    /// All events at a sampled step, before or after the outcome, so that length reveals nothing: the smaller
    /// of two uniformly sampled steps, since long events in which all is settled show little.
    Drawn,
}

impl Selection {
    /// The length of an event (steps; minimum and maximum), if it is sampled. `seed` is that of the attempt
    /// and `slot` that of the slot: rejections must not affect a length that is the same for all kinds.
    #[must_use]
    pub fn sampled_length(&self, relation: Relation, seed: u64, slot: u64) -> Option<(usize, usize)> {
        let ends = self.max_steps.saturating_sub(self.min_steps) as u64 + 1;
        // The range is so small that the remainder introduces no noticeable bias.
        let drawn =
            |seed, k| self.min_steps + (random::derive_seed(seed, Purpose::Length, k) % ends) as usize;
        match self.ends {
            Ends::AdversarialDrawn if relation == Relation::Adversarial => Some((0, drawn(seed, 0))),
            Ends::Settled | Ends::AdversarialDrawn => None,
            Ends::Drawn => {
                let length = drawn(slot, 0).min(drawn(slot, 1));
                Some((length, length))
            }
        }
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

/// Events of several kinds that share bodies: a block has one stage, and one event for each column.
#[derive(Clone, PartialEq, Eq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Blocks {
    /// For each event of a block, the variants that it has in turn. The first column proposes the bodies.
    pub columns: Vec<Vec<Variant>>,
    /// Whether those who compete or chase start where they meet soon ([`Part`](phase_sampler::Part)).
    #[serde(default)]
    pub meet_soon: bool,
    /// The blocks, grouped by the part of the dataset that they belong to.
    pub groups: Vec<BlockGroup>,
}

/// Blocks in the same part of the dataset.
#[derive(Clone, PartialEq, Eq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BlockGroup {
    /// The part of the dataset, if it is divided.
    pub split: Option<Split>,
    /// One of the names in `layouts`.
    pub layouts: String,
    /// Number of blocks.
    pub blocks: usize,
    /// Variants that others replace in these blocks.
    #[serde(default)]
    pub replace: BTreeMap<Variant, Variant>,
}

/// Sets of events that differ in the stance of one agent; see [`phase_sampler::contrast`].
#[derive(Clone, PartialEq, Eq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SetGroup {
    /// The stances of the changed agent, one event each.
    pub stances: Vec<Stance>,
    /// Subject of the other agent's goal: an object or a place.
    pub about: About,
    /// The part of the dataset, if it is divided.
    pub split: Option<Split>,
    /// One of the names in `layouts`.
    pub layouts: String,
    /// Number of sets.
    pub sets: usize,
}

impl Preset {
    /// Reads a preset from text; `name` refers to it in messages.
    ///
    /// # Errors
    /// If the text is not a preset, lists no events, or names layouts that do not exist.
    pub fn parse(name: impl AsRef<Path>, text: &str) -> Result<Self, FileError> {
        let what = "preset";
        let fail = |problem| FileError { file: name.as_ref().to_owned(), problem };
        let preset: Self = parse_as(text).map_err(|source| fail(Problem::Incomplete { what, source }))?;
        preset.check().map_err(|rule| fail(Problem::Shape { what, rule }))?;
        Ok(preset)
    }

    fn check(&self) -> Result<(), String> {
        if self.format != PRESET_FORMAT {
            return Err(format!("field `format` must be {PRESET_FORMAT:?}"));
        }
        if self.name.is_empty() || self.name.len() > 60 {
            return Err("field `name` must have 1 to 60 letters".into());
        }
        // Ids begin with it.
        check_id(&self.id(0)).map_err(|rule| format!("field `name` with a number {rule}"))?;
        let given = [!self.groups.is_empty(), self.blocks.is_some(), !self.sets.is_empty()];
        if given.into_iter().filter(|&given| given).count() != 1 {
            return Err(
                "one of the fields `groups`, `blocks` and `sets` must be given, and not be empty".into()
            );
        }
        self.sets.iter().try_for_each(SetGroup::check)?;
        if !self.sets.is_empty() && !self.selection.is_some_and(|it| it.ends == Ends::Drawn) {
            return Err(
                "`sets` need a `selection` whose `ends` is \"drawn\", so that all events of a set are \
                        equally long"
                    .into(),
            );
        }
        if !self.sets.is_empty() && !self.levels.is_empty() {
            return Err("`levels` need `groups` or `blocks`: agents of `sets` know each other's goals".into());
        }
        self.check_counts().map_err(|error| error.to_string())?;
        let events = self.events();
        EVENTS.check_count(events).map_err(|error| format!("{}, in all", error.rule()))?;
        if let Some(blocks) = &self.blocks {
            if blocks.columns.is_empty() || blocks.columns.iter().any(Vec::is_empty) {
                return Err("field `columns` of `blocks` must not be empty, nor any of its lists".into());
            }
            if blocks.groups.is_empty() {
                return Err("field `groups` of `blocks` must not be empty".into());
            }
        }
        for (name, bases) in &self.layouts {
            if let Some(base) = bases.iter().find(|base| !USED_BASES.contains(base)) {
                return Err(format!("layouts.{name} names base {base}, which no event is made in"));
            }
        }
        let of_blocks = self.blocks.iter().flat_map(|blocks| &blocks.groups).map(|group| &group.layouts);
        let of_sets = self.sets.iter().map(|group| &group.layouts);
        let mut named = self.groups.iter().map(|group| &group.layouts).chain(of_blocks).chain(of_sets);
        if let Some(name) = named.find(|name| self.layouts.get(*name).is_none_or(Vec::is_empty)) {
            return Err(format!("there are no layouts of the name {name:?}"));
        }
        if self.selection.is_some_and(|it| it.min_steps > it.max_steps) {
            return Err("selection needs min_steps no greater than max_steps".into());
        }
        Ok(())
    }

    /// That counts are of a size that memory and time allow.
    fn check_counts(&self) -> Result<(), RangeError> {
        let count = |setting: Setting, count: usize, path: String| {
            setting.check_count(count).map(|_| ()).map_err(|error| error.within(&path))
        };
        for (k, group) in self.groups.iter().enumerate() {
            count(EVENTS, group.events, format!("groups[{k}]"))?;
        }
        let blocks = self.blocks.iter().flat_map(|blocks| &blocks.groups);
        for (k, group) in blocks.enumerate() {
            count(Setting { name: "blocks", ..EVENTS }, group.blocks, format!("blocks.groups[{k}]"))?;
        }
        for (k, group) in self.sets.iter().enumerate() {
            count(Setting { name: "sets", ..EVENTS }, group.sets, format!("sets[{k}]"))?;
        }
        if let Some(selection) = self.selection {
            count(MIN_STEPS, selection.min_steps, "selection".into())?;
            count(EVENT_STEPS, selection.max_steps, "selection".into())?;
            count(ATTEMPTS, selection.attempts, "selection".into())?;
        }
        Ok(())
    }

    /// Default number of events.
    #[must_use]
    pub fn events(&self) -> usize {
        let blocks = self.blocks.as_ref().map_or(0, |blocks| {
            blocks.columns.len() * blocks.groups.iter().map(|group| group.blocks).sum::<usize>()
        });
        let sets = self.sets.iter().map(|group| group.sets * group.stances.len()).sum::<usize>();
        blocks + sets + self.groups.iter().map(|group| group.events).sum::<usize>()
    }

    /// The layouts of a name.
    #[must_use]
    pub fn pool(&self, name: &str) -> Vec<Layout> {
        let bases: BTreeSet<u8> = self.layouts.get(name).into_iter().flatten().copied().collect();
        Layout::all_used().filter(|layout| bases.contains(&layout.base())).collect()
    }

    /// The id of the slot with this number: that of its event, or of its set.
    #[must_use]
    pub fn id(&self, index: usize) -> String {
        slot_id(&self.name, index)
    }
}

impl SetGroup {
    fn check(&self) -> Result<(), String> {
        let distinct: BTreeSet<Stance> = self.stances.iter().copied().collect();
        if distinct.len() < 2 || distinct.len() != self.stances.len() {
            return Err("field `stances` must name two or more different stances".into());
        }
        let of_beliefs = self.stances.iter().filter(|stance| stance.sight().is_some()).count();
        if of_beliefs != 0 && of_beliefs != self.stances.len() {
            return Err(
                "the stances unaware and told make sets of their own: only in these an agent waits".into()
            );
        }
        match self.stances.iter().find(|stance| !stance.suits(self.about)) {
            Some(stance) => Err(format!("the stance {} needs a goal about an object", stance.name())),
            None => Ok(()),
        }
    }
}

/// The name of a slot, which is that of its event, or of its set.
#[must_use]
pub fn slot_id(preset: &str, index: usize) -> String {
    format!("{preset}-{index:04}")
}
