//! Assignment of videos to raters: the least rated videos first, ties at random, in random order.

use crate::config::StudyConfig;
use phase_model::random::{Purpose, stream};
use rand::{Rng, RngExt};
use std::{cmp::Reverse, collections::BTreeMap};

/// One thing that a rater is shown.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Shown {
    /// The stimulus of this index.
    Stimulus(usize),
    /// The catch trial of this index.
    CatchTrial(usize),
}

/// The trials of a rater in order: [`StudyConfig::videos_per_rater`] videos of one group that the fewest
/// raters have (`load`, by index of the stimulus), at random where several have as few, and all catch trials,
/// in random order; of each set one video alone, if the configuration wants that. Fewer videos where too few
/// of the group have less than [`StudyConfig::raters_per_video_at_most`]; `None` where no video of any group
/// has.
///
/// The configuration's seed and the rater's number decide what is random. Of several groups it is the one
/// that lacks most judgements. `load` must have a number for each stimulus.
#[must_use]
pub fn assign(config: &StudyConfig, load: &[u32], rater: u64) -> Option<Vec<Shown>> {
    let mut random = stream(config.seed, Purpose::Assignment, rater);
    let mut groups = config.groups();
    shuffle(&mut groups, &mut random);
    let lacks = |bound: u32| {
        move |group: &Vec<usize>| group.iter().map(|&k| u64::from(bound.saturating_sub(load[k]))).sum::<u64>()
    };
    let wanted = lacks(config.raters_per_video);
    let room = lacks(config.raters_per_video_at_most);
    // The first of the greatest, for the groups are in random order.
    let group = groups.into_iter().rev().max_by_key(|group| (wanted(group), room(group)))?;
    let mut open: Vec<usize> =
        group.into_iter().filter(|&k| load[k] < config.raters_per_video_at_most).collect();
    if open.is_empty() {
        return None;
    }
    shuffle(&mut open, &mut random);
    open.sort_by_key(|&k| load[k]);
    if config.one_of_each_set {
        open = one_of_each_set(config, load, &open);
    }
    open.truncate(config.videos_per_rater as usize);
    let catch_trials = (0..config.catch_trials.len()).map(Shown::CatchTrial);
    let mut trials: Vec<Shown> = open.into_iter().map(Shown::Stimulus).chain(catch_trials).collect();
    shuffle(&mut trials, &mut random);
    Some(trials)
}

/// Of videos in the order of their load the first of each set, and those of no set; first those whose set
/// lacks most judgements, for a set of several videos takes as many raters more.
fn one_of_each_set(config: &StudyConfig, load: &[u32], open: &[usize]) -> Vec<usize> {
    let mut lacking = BTreeMap::<&str, u32>::new();
    let lacks = |k: usize| config.raters_per_video.saturating_sub(load[k]);
    let mut chosen = Vec::new();
    for &k in open {
        match config.stimuli[k].set.as_deref() {
            Some(set) => {
                if !lacking.contains_key(set) {
                    chosen.push(k);
                }
                *lacking.entry(set).or_default() += lacks(k);
            }
            None => chosen.push(k),
        }
    }
    let lacks_in_all = |&k: &usize| {
        let set = config.stimuli[k].set.as_deref();
        (Reverse(set.map_or_else(|| lacks(k), |set| lacking[set])), load[k])
    };
    chosen.sort_by_key(lacks_in_all);
    chosen
}

/// Puts items in random order (Fisher and Yates).
fn shuffle<T>(items: &mut [T], random: &mut impl Rng) {
    for k in (1..items.len()).rev() {
        items.swap(k, random.random_range(0..=k));
    }
}
