//! Composition of a generated dataset: the slots that a preset describes, each for an event or a set of
//! events.

use crate::{
    preset::{Blocks, Preset, PresetGroup, SetGroup},
    splits::Split,
};
use phase_evidence::Manner;
use phase_model::{Knowledge, Level, Scene};
use phase_sampler::{About, Part, Stance, Variant};
use std::collections::BTreeMap;

/// A place for one event of a dataset, with everything that is decided before a scene is drawn.
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
    /// The block whose bodies it has, if it shares them.
    pub block: Option<BlockPlace>,
    /// The level of reasoning of its agents, if they do not know each other's goals.
    pub level: Option<Level>,
}

impl EventSlot {
    /// Its part in the block whose bodies it shares.
    #[must_use]
    pub fn part(&self) -> Part {
        let Self { variant, goal_index, block, .. } = *self;
        Part { variant, goal_index, meet_soon: block.is_some_and(|block| block.meet_soon) }
    }

    /// A scene of this slot with the knowledge of its agents.
    #[must_use]
    pub fn with_knowledge(&self, mut scene: Scene) -> Scene {
        if let Some(level) = self.level {
            scene.agents.iter_mut().for_each(|agent| agent.awareness.knows = Knowledge::Nothing(level));
        }
        scene
    }
}

/// The place of an event in a block of events that share their bodies.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct BlockPlace {
    /// Number of the block in the dataset.
    pub block: usize,
    /// Number of the dataset's first event in it.
    pub first: usize,
    /// Events in it.
    pub events: usize,
    /// Whether those who compete or chase in it start where they meet soon.
    pub meet_soon: bool,
}

/// A place for a set of events that differ in the stance of one agent.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SetSlot {
    /// The stances, one event each.
    pub stances: Vec<Stance>,
    /// Subject of the other agent's goal: an object or a place.
    pub about: About,
    /// Index of that goal.
    pub goal_index: usize,
    /// The part of the dataset, if it is divided.
    pub split: Option<Split>,
    /// The name of the layouts.
    pub layouts: String,
}

/// The slots of a preset: its groups interleaved evenly, repeated for larger datasets. Goals rotate, so that
/// they stay balanced.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Composition {
    slots: Vec<EventSlot>,
    sets: Vec<SetSlot>,
    turns: BTreeMap<Variant, usize>,
    blocks: usize,
    levels: Vec<Level>,
}

impl Composition {
    /// The slots of a preset.
    #[must_use]
    pub fn of(preset: &Preset) -> Self {
        let levels = preset.levels.clone();
        let mut new = Self { slots: Vec::new(), sets: Vec::new(), turns: BTreeMap::new(), blocks: 0, levels };
        if let Some(blocks) = &preset.blocks {
            new.add_blocks(blocks);
        }
        for group in interleaved(&preset.groups, |group| group.events) {
            let PresetGroup { variant, split, ref layouts, .. } = *group;
            let goal_index = new.turn(variant);
            let layouts = layouts.clone();
            new.slots.push(EventSlot { variant, goal_index, split, layouts, block: None, level: None });
        }
        for (goal_index, group) in interleaved(&preset.sets, |group| group.sets).into_iter().enumerate() {
            let SetGroup { stances, about, split, layouts, .. } = group.clone();
            new.sets.push(SetSlot { stances, about, goal_index, split, layouts });
        }
        new
    }

    /// Number of slots for this number of events: as many, unless they come in sets. `None` if the last set
    /// would be incomplete.
    #[must_use]
    pub fn slots(&self, events: usize) -> Option<usize> {
        let mut slots = 0;
        let mut covered = 0;
        while covered < events {
            covered += self.set(slots).map_or(1, |set| set.stances.len());
            slots += 1;
        }
        (covered == events).then_some(slots)
    }

    /// The numbers of events next to this one, below and above, of which no set is incomplete.
    #[must_use]
    pub fn whole_sets_around(&self, events: usize) -> (usize, usize) {
        let (mut slots, mut below, mut above) = (0, 0, 0);
        while above <= events {
            below = above;
            above += self.set(slots).map_or(1, |set| set.stances.len());
            slots += 1;
        }
        (below, above)
    }

    /// The slot of the set with this number, from 0; `None` if the dataset does not consist of sets.
    #[must_use]
    pub fn set(&self, index: usize) -> Option<SetSlot> {
        let slot = self.sets.get(index % self.sets.len().max(1))?;
        let round = index / self.sets.len();
        Some(SetSlot { goal_index: slot.goal_index + round * self.sets.len(), ..slot.clone() })
    }

    fn add_blocks(&mut self, blocks: &Blocks) {
        let events = blocks.columns.len();
        for (number, group) in interleaved(&blocks.groups, |group| group.blocks).into_iter().enumerate() {
            let block = Some(BlockPlace {
                block: number,
                first: self.slots.len(),
                events,
                meet_soon: blocks.meet_soon,
            });
            for column in &blocks.columns {
                let listed = column[number % column.len()];
                let variant = group.replace.get(&listed).copied().unwrap_or(listed);
                let goal_index = self.turn(variant);
                let split = group.split;
                let layouts = group.layouts.clone();
                self.slots.push(EventSlot { variant, goal_index, split, layouts, block, level: None });
            }
            self.blocks = number + 1;
        }
    }

    /// The next pair of goals of a variant.
    fn turn(&mut self, variant: Variant) -> usize {
        let next = self.turns.entry(variant).or_default();
        *next += 1;
        *next - 1
    }

    /// The slot of the event with this number, from 0, of a dataset that does not consist of sets.
    #[must_use]
    pub fn slot(&self, index: usize) -> EventSlot {
        let slot = &self.slots[index % self.slots.len()];
        let round = index / self.slots.len();
        let turns = self.turns.get(&slot.variant).copied().unwrap_or_default();
        let block = slot.block.map(|place| BlockPlace {
            block: place.block + round * self.blocks,
            first: place.first + round * self.slots.len(),
            ..place
        });
        let goal_index = slot.goal_index + round * turns;
        let turn = block.map_or(goal_index, |place| place.block);
        let level = self.levels.get(turn % self.levels.len().max(1)).copied();
        EventSlot { goal_index, block, level, ..slot.clone() }
    }

    /// The events that share bodies with one of them, in order.
    #[must_use]
    pub fn parts(&self, place: BlockPlace) -> Vec<Part> {
        let slots = (place.first..place.first + place.events).map(|index| self.slot(index));
        slots.map(|slot| slot.part()).collect()
    }
}

/// Each group as often as it counts, evenly distributed: item j of n is at (2 j + 1) / 2 n of the way, and
/// equal places keep the groups' order.
fn interleaved<T>(groups: &[T], count: impl Fn(&T) -> usize) -> Vec<&T> {
    let mut places: Vec<(usize, usize, &T)> = groups
        .iter()
        .flat_map(|group| (0..count(group)).map(move |j| (j, group)))
        .map(|(j, group)| (j, count(group), group))
        .collect();
    places.sort_by(|(a, n, _), (b, m, _)| ((2 * a + 1) * m).cmp(&((2 * b + 1) * n)));
    places.into_iter().map(|(_, _, group)| group).collect()
}

/// The manner that an event of a variant has to show where its end is sampled, if the variant is about one.
#[must_use]
pub const fn manner_of(variant: Variant) -> Option<Manner> {
    match variant {
        Variant::Lift => Some(Manner::CarryingAlong),
        Variant::Fetch => Some(Manner::Fetching),
        Variant::HandOver => Some(Manner::HandingOver),
        Variant::Move => Some(Manner::Clearing),
        Variant::MakeWay => Some(Manner::MakingWay),
        Variant::Block => Some(Manner::Blocking),
        Variant::Take => Some(Manner::Taking),
        Variant::Drag => Some(Manner::Dragging),
        Variant::Hide => Some(Manner::Hiding),
        Variant::Undo => Some(Manner::Undoing),
        Variant::Cross => Some(Manner::Crossing),
        _ => None,
    }
}
