//! Decisions of a mind that does not know the other's: acting or watching.

use crate::{ascription::TheoryParameters, theory::Supposition};
use phase_event::BelievedIntent;
use phase_model::{Attitude, Intent, Level, PhysicsConfig};
use phase_planner::{Candidate, Planner};
use std::collections::BTreeMap;

/// The additional parts of a mind that does not know the other's.
#[derive(Clone, Debug)]
pub(crate) struct Ignorance<D> {
    pub(crate) level: Level,
    pub(crate) theory: TheoryParameters,
    /// Physics and dynamics for each strength of the other.
    pub(crate) worlds: Vec<(PhysicsConfig, D)>,
    /// The agent's own planner for each supposition, made when first needed.
    pub(crate) planners: BTreeMap<Supposition, Planner>,
    /// Steps of watching, less those of acting since.
    pub(crate) watched: u32,
}

impl<D> Ignorance<D> {
    /// The subgoal to pursue; `None` if there is none, or if the agent had better watch the other first.
    ///
    /// A helper or hinderer with a wrong idea of the other may bring about the opposite of what it wants. So
    /// one that reasons about the other's mind pursues a subgoal only once enough of the particles have
    /// intents that suggest it; where bodies are does not have to be certain. How many are enough falls with
    /// the time that it has watched, so that an agent that learns nothing more tries.
    pub(crate) fn best<'c>(
        &self,
        attitude: Attitude,
        suppositions: &[Supposition],
        candidates: &'c [Candidate],
    ) -> Option<&'c Candidate> {
        if suppositions.is_empty() || attitude == Attitude::Neutral || self.level == Level::Zero {
            return candidates.first();
        }
        let count = suppositions.len() as f64;
        let theory = &self.theory;
        let patience = 1.0 - (f64::from(self.watched) / theory.patience).min(1.0);
        let agree = |candidate: &&Candidate| {
            let intents: Vec<Intent> = candidate.particles.iter().map(|&k| suppositions[k].intent).collect();
            let agreeing = suppositions.iter().filter(|it| intents.contains(&it.intent)).count() as f64;
            agreeing >= theory.confidence * patience * count
        };
        candidates.iter().find(agree)
    }

    /// Counts a step of watching, or of acting.
    pub(crate) const fn count_watching(&mut self, watches: bool) {
        self.watched = if watches { self.watched + 1 } else { self.watched.saturating_sub(1) };
    }
}

/// The intents that the particles suppose, the commonest first.
pub(crate) fn believed(suppositions: &[Supposition]) -> Vec<BelievedIntent> {
    let mut counts: BTreeMap<Intent, usize> = BTreeMap::new();
    for supposition in suppositions {
        *counts.entry(supposition.intent).or_default() += 1;
    }
    let mut believed: Vec<BelievedIntent> =
        counts.into_iter().map(|(intent, particles)| BelievedIntent { intent, particles }).collect();
    believed.sort_by(|a, b| b.particles.cmp(&a.particles).then(a.intent.cmp(&b.intent)));
    believed
}

/// The supposition that most have; of several, the least.
pub(crate) fn commonest(suppositions: &[Supposition]) -> Option<Supposition> {
    let mut counts: BTreeMap<Supposition, usize> = BTreeMap::new();
    for supposition in suppositions {
        *counts.entry(*supposition).or_default() += 1;
    }
    counts.into_iter().max_by(|a, b| a.1.cmp(&b.1).then(b.0.cmp(&a.0))).map(|(supposition, _)| supposition)
}
