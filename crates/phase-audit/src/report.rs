//! The audit: accuracies by features and targets.

use crate::{AuditItem, Feature, Target, folds::folds, forest, target::TARGETS};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Folds of the cross-validation.
const FOLDS: usize = 5;
/// Minimum number of events for an audit: below, accuracies are chance.
const MIN_EVENTS: usize = 50;
/// Maximum number of events in an audit. Of a larger dataset the first ones are taken; the standard error of
/// a share is then below 0.01.
pub const MAX_EVENTS: usize = 3000;
/// Seed of folds and forests.
const SEED: u64 = 1;

/// Accuracies of one group of features.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AuditRow {
    /// The features.
    pub feature: Feature,
    /// The cross-validated share of events named right, by [`Target::ALL`]; 0 to 1.
    pub accuracies: [f64; TARGETS],
}

/// The result of an audit.
#[derive(Clone, PartialEq, Debug)]
pub struct Audit {
    /// Number of events audited.
    pub events: usize,
    /// Number of events in the dataset.
    pub of: usize,
    /// The share of the most frequent class, by [`Target::ALL`].
    pub majorities: [f64; TARGETS],
    /// One row for each of [`Feature::ALL`].
    pub rows: Vec<AuditRow>,
}

impl Audit {
    /// The targets of which there is more than one class, so that there is something to tell.
    pub fn targets(&self) -> impl Iterator<Item = Target> + '_ {
        Target::ALL.into_iter().filter(|&target| self.majorities[target as usize] < 1.0)
    }

    /// Accuracy of all motion-free features together, less the share of the most frequent class; may be
    /// negative.
    #[must_use]
    pub fn excess(&self, target: Target) -> f64 {
        let all = self.rows.iter().find(|row| row.feature == Feature::All);
        all.map_or(0.0, |row| row.accuracies[target as usize] - self.majorities[target as usize])
    }
}

/// Audits the first events of a dataset that has `of` of them. `None` for fewer than fifty events, in which
/// accuracies would be chance. No more than [`MAX_EVENTS`] are used.
#[must_use]
pub fn audit(items: &[AuditItem], of: usize) -> Option<Audit> {
    let items = &items[..items.len().min(MAX_EVENTS)];
    if items.len() < MIN_EVENTS {
        return None;
    }
    let stages: Vec<&[u32]> = items.iter().map(|item| item.stage.as_slice()).collect();
    let folds = folds(&stages, FOLDS, SEED);
    let targets = Target::ALL.map(|target| classes(items, target));
    let cells: Vec<(Feature, usize)> =
        Feature::ALL.into_iter().flat_map(|feature| (0..targets.len()).map(move |k| (feature, k))).collect();
    let accuracies: Vec<f64> = cells
        .par_iter()
        .map(|&(feature, target)| accuracy(items, feature, &targets[target], &folds))
        .collect();
    let rows = Feature::ALL.into_iter().zip(accuracies.chunks(targets.len()));
    Some(Audit {
        events: items.len(),
        of,
        majorities: targets.each_ref().map(|classes| majority(classes)),
        rows: rows
            .map(|(feature, found)| AuditRow {
                feature,
                accuracies: core::array::from_fn(|target| found[target]),
            })
            .collect(),
    })
}

/// Classes as numbers.
fn classes(items: &[AuditItem], target: Target) -> Vec<u32> {
    let names: BTreeSet<&str> = items.iter().map(|item| item.classes[target as usize].as_str()).collect();
    let numbers: BTreeMap<&str, u32> = names.into_iter().zip(0..).collect();
    items.iter().map(|item| numbers[item.classes[target as usize].as_str()]).collect()
}

fn majority(classes: &[u32]) -> f64 {
    let mut counts: BTreeMap<u32, usize> = BTreeMap::new();
    for &class in classes {
        *counts.entry(class).or_default() += 1;
    }
    counts.values().max().copied().unwrap_or(0) as f64 / classes.len().max(1) as f64
}

/// The share of items whose class is predicted by a forest.
fn accuracy(items: &[AuditItem], feature: Feature, classes: &[u32], folds: &[usize]) -> f64 {
    let rows: Vec<&Vec<f64>> = items.iter().map(|item| &item.features[feature as usize]).collect();
    let predicted = across_folds(&rows, classes, folds);
    predicted.iter().zip(classes).filter(|(predicted, class)| predicted == class).count() as f64
        / items.len() as f64
}

/// The class of every row by a random forest that was trained on the other rows, in five folds. Rows with the
/// same key in `stages` are in one fold. All slices have the same length, and all rows have one length.
#[must_use]
pub fn cross_validated(rows: &[Vec<f64>], classes: &[u32], stages: &[&[u32]]) -> Vec<u32> {
    across_folds(&rows.iter().collect::<Vec<_>>(), classes, &folds(stages, FOLDS, SEED))
}

/// The class of every row by a forest trained on the other folds. Where a forest cannot be trained, for
/// example on a single class, the most frequent class is predicted.
fn across_folds(all: &[&Vec<f64>], classes: &[u32], folds: &[usize]) -> Vec<u32> {
    let mut predicted = vec![0; all.len()];
    for fold in 0..FOLDS {
        let (test, train): (Vec<usize>, Vec<usize>) = (0..all.len()).partition(|&k| folds[k] == fold);
        let [rows, others] = [&train, &test].map(|set| set.iter().map(|&k| all[k]).collect::<Vec<_>>());
        let known: Vec<u32> = train.iter().map(|&k| classes[k]).collect();
        let found = forest::predict(&rows, &known, &others, SEED)
            .unwrap_or_else(|_| vec![most_frequent(&known); test.len()]);
        for (k, class) in test.into_iter().zip(found) {
            predicted[k] = class;
        }
    }
    predicted
}

fn most_frequent(classes: &[u32]) -> u32 {
    let mut counts: BTreeMap<u32, usize> = BTreeMap::new();
    for &class in classes {
        *counts.entry(class).or_default() += 1;
    }
    counts.into_iter().max_by_key(|&(_, count)| count).map_or(0, |(class, _)| class)
}

/// The audit as a table in Markdown, with the majority's shares in the first row; targets of a single class
/// are left out.
#[must_use]
pub fn table(audit: &Audit) -> String {
    let line = |name: &str, cell: &dyn Fn(Target) -> String| {
        audit.targets().fold(format!("| {name} |"), |line, target| format!("{line} {} |", cell(target)))
            + "\n"
    };
    let shares =
        |name: &str, shares: &[f64; TARGETS]| line(name, &|target| format!("{:.3}", shares[target as usize]));
    let mut text = line("told from", &|target| target.name().to_owned());
    text += &format!("|---|{}\n", "---|".repeat(audit.targets().count()));
    text += &shares("nothing (the most frequent class)", &audit.majorities);
    for row in &audit.rows {
        text += &shares(row.feature.name(), &row.accuracies);
    }
    text
}

/// The finding of the table, in a sentence.
#[must_use]
pub fn summary(audit: &Audit) -> String {
    const TOLD: [Target; 3] = [Target::Relation, Target::Kind, Target::Knowledge];
    let one = |target: Target| {
        let majority = audit.majorities[target as usize];
        let all = majority + audit.excess(target);
        format!("the {} of {all:.3} of the events (most frequent class {majority:.3})", target.name())
    };
    let told: Vec<String> = audit.targets().filter(|target| TOLD.contains(target)).map(one).collect();
    if told.is_empty() {
        return "all events have one relation and one kind, so that there is nothing to tell".into();
    }
    format!("a random forest that sees no motion tells {}", told.join(", and "))
}
