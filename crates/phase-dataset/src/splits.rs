//! Dividing a dataset into training, validation and test events.
//!
//! The rules are the paper's (section "Dataset Statistics"), in proportion for datasets of other sizes: 64 %
//! train, 16 % validation, 20 % test; four fifths of the test events in layouts that no other event has; and
//! 9 of 500 events, all in the test set, of an interaction type that occurs nowhere else. A layout counts as
//! seen if its base layout is, in whatever reflection, which is the stricter reading.

use crate::labels::interaction_type;
use phase_model::{AGENT_COUNT, EventKind, Goal, random};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// A part of a dataset.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Split {
    /// For training.
    Train,
    /// For validation (model selection).
    Validation,
    /// For testing.
    Test,
}

impl Split {
    /// All parts.
    pub const ALL: [Self; 3] = [Self::Train, Self::Validation, Self::Test];

    /// The name used in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Train => "train",
            Self::Validation => "validation",
            Self::Test => "test",
        }
    }
}

/// The properties of an event that determine which splits it may belong to.
#[derive(Clone, PartialEq, Debug)]
pub struct Item {
    /// Its name.
    pub id: String,
    /// Its kind.
    pub kind: EventKind,
    /// Its goals.
    pub goals: [Goal; AGENT_COUNT],
    /// Its base layout.
    pub base: u8,
}

/// Numbers of events of a dataset that belong to each split.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct SplitQuota {
    /// Training events.
    pub train: usize,
    /// Validation events.
    pub validation: usize,
    /// Test events.
    pub test: usize,
    /// Of the test events, those in held-out layouts.
    pub unseen: usize,
    /// Of the test events, those of a held-out interaction type.
    pub exclusive: usize,
}

impl SplitQuota {
    /// The quota of a dataset of this size, to the nearest event.
    #[must_use]
    pub const fn of(events: usize) -> Self {
        let test = rounded(events, 1, 5);
        let validation = rounded(events, 4, 25);
        Self {
            train: events.saturating_sub(test + validation),
            validation,
            test,
            unseen: rounded(test, 4, 5),
            exclusive: rounded(events, 9, 500),
        }
    }
}

/// One rule, with the required and the actual number.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Rule {
    /// In words.
    pub what: &'static str,
    /// Number of events that the rule asks for.
    pub wanted: usize,
    /// Number of events that the split has.
    pub found: usize,
}

impl Rule {
    /// Whether there are as many as there should be.
    #[must_use]
    pub const fn met(&self) -> bool {
        self.wanted == self.found
    }
}

/// Counts a split against the rules; one part for each event.
#[must_use]
pub fn check(items: &[Item], parts: &[Split]) -> Vec<Rule> {
    let quota = SplitQuota::of(items.len());
    let of = |part: Split| items.iter().zip(parts).filter(move |(_, it)| **it == part).map(|(item, _)| item);
    let learnt: Vec<&Item> = of(Split::Train).chain(of(Split::Validation)).collect();
    let bases: BTreeSet<u8> = learnt.iter().map(|item| item.base).collect();
    let types: BTreeSet<String> = learnt.iter().map(|item| type_of(item)).collect();
    let unseen = of(Split::Test).filter(|item| !bases.contains(&item.base)).count();
    let exclusive = of(Split::Test).filter(|item| !types.contains(&type_of(item))).count();
    vec![
        Rule { what: "train", wanted: quota.train, found: of(Split::Train).count() },
        Rule { what: "validation", wanted: quota.validation, found: of(Split::Validation).count() },
        Rule { what: "test", wanted: quota.test, found: of(Split::Test).count() },
        Rule { what: "test in layouts seen nowhere else", wanted: quota.unseen, found: unseen },
        Rule { what: "test of a type seen nowhere else", wanted: quota.exclusive, found: exclusive },
    ]
}

/// Divides a dataset by the rules, as far as its events allow; [`check`] tells how far that is. Within the
/// rules the seed decides, and kinds are distributed evenly.
#[must_use]
pub fn make(items: &[Item], seed: u64) -> Vec<Split> {
    let quota = SplitQuota::of(items.len());
    let key = |k: usize| random::derive_seed(seed, random::Purpose::Event, k as u64);
    let exclusive = exclusive_type(items, &quota);
    let held_out = held_out_bases(items, &quota, seed);
    let mut parts = vec![Split::Train; items.len()];
    let mut free: Vec<usize> = Vec::new();
    for (k, item) in items.iter().enumerate() {
        if held_out.contains(&item.base) || exclusive.as_ref() == Some(&type_of(item)) {
            parts[k] = Split::Test;
        } else {
            free.push(k);
        }
    }
    free.sort_by_key(|&k| (items[k].kind, key(k)));
    let tested = items.len() - free.len();
    for (part, count) in
        [(Split::Test, quota.test.saturating_sub(tested)), (Split::Validation, quota.validation)]
    {
        let chosen = evenly(&free, count);
        for &k in &chosen {
            parts[k] = part;
        }
        free.retain(|k| !chosen.contains(k));
    }
    parts
}

/// The interaction type whose number of events is closest to the wanted one and does not exceed what the test
/// set has room for beside unseen layouts; the first of several.
fn exclusive_type(items: &[Item], quota: &SplitQuota) -> Option<String> {
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for item in items {
        *counts.entry(type_of(item)).or_default() += 1;
    }
    let fits = |&(_, count): &(String, usize)| count <= quota.test - quota.unseen;
    counts
        .into_iter()
        .filter(fits)
        .min_by_key(|&(_, count)| count.abs_diff(quota.exclusive))
        .map(|(it, _)| it)
}

/// Base layouts that together have as many events as there are to be in unseen layouts, or as close to it as
/// possible without exceeding it.
fn held_out_bases(items: &[Item], quota: &SplitQuota, seed: u64) -> BTreeSet<u8> {
    let mut counts: BTreeMap<u8, usize> = BTreeMap::new();
    for item in items {
        *counts.entry(item.base).or_default() += 1;
    }
    let mut bases: Vec<(u8, usize)> = counts.into_iter().collect();
    bases.sort_by_key(|&(base, _)| random::derive_seed(seed, random::Purpose::Scene, base.into()));
    // For each sum that can be reached, the first set of bases found to reach it.
    let mut sets: BTreeMap<usize, BTreeSet<u8>> = BTreeMap::from([(0, BTreeSet::new())]);
    for (base, count) in bases {
        let reached: Vec<(usize, BTreeSet<u8>)> = sets.clone().into_iter().collect();
        for (sum, mut set) in reached {
            if sum + count <= quota.unseen {
                set.insert(base);
                sets.entry(sum + count).or_insert(set);
            }
        }
    }
    sets.pop_last().map(|(_, set)| set).unwrap_or_default()
}

/// The given number of items, evenly spaced.
fn evenly(things: &[usize], count: usize) -> BTreeSet<usize> {
    let count = count.min(things.len());
    (0..count).map(|k| things[(2 * k + 1) * things.len() / (2 * count)]).collect()
}

fn type_of(item: &Item) -> String {
    interaction_type(item.kind, item.goals)
}

/// `number` · `times` / `over`, rounded half up.
const fn rounded(number: usize, times: usize, over: usize) -> usize {
    (2 * number * times + over) / (2 * over)
}
