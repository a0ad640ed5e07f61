//! Folds of a cross-validation in which events that share their bodies stay together.

use phase_model::random::{self, Purpose};
use std::collections::BTreeMap;

/// The fold of each item, from 0, by its stage.
///
/// Stages are dealt out in random order, each to the fold that has the fewest
/// items.
pub(crate) fn folds(of: &[&[u32]], count: usize, seed: u64) -> Vec<usize> {
    let mut stages: BTreeMap<&[u32], Vec<usize>> = BTreeMap::new();
    for (k, stage) in of.iter().enumerate() {
        stages.entry(stage).or_default().push(k);
    }
    let mut stages: Vec<Vec<usize>> = stages.into_values().collect();
    stages.sort_by_key(|stage| random::derive_seed(seed, Purpose::Evaluation, stage[0] as u64));
    let mut folds = vec![0; of.len()];
    let mut sizes = vec![0_usize; count];
    for stage in stages {
        let fold = (0..count).min_by_key(|&fold| sizes[fold]).unwrap_or(0);
        sizes[fold] += stage.len();
        for k in stage {
            folds[k] = fold;
        }
    }
    folds
}
