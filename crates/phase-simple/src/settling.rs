//! A quick bound on what a closer look at an intent can change.

use crate::{Hypothesis, Intent, answer::log_evidence, guide::intent_of};
use phase_model::AgentId;

/// The share that the hypotheses with each of some intents of an agent have among all, by ln P(Y, motion).
pub(crate) fn shares(
    joint: &[(Hypothesis, f64)],
    agent: AgentId,
    intents: impl Iterator<Item = Intent>,
) -> Vec<f64> {
    let sum = log_evidence(joint);
    let share = |intent: Intent| {
        let with = joint.iter().filter(|(hypothesis, _)| intent_of(hypothesis, agent) == intent);
        with.map(|(_, log)| libm::exp(log - sum)).sum()
    };
    intents.map(share).collect()
}

/// The share of the hypotheses with an intent among those that were simulated for a kind of minds, 0 to 1.
#[derive(Clone, Copy)]
pub(crate) struct ShareInKinds {
    /// At the kind's own lapse rate.
    pub(crate) own: f64,
    /// At the rate at which kinds are compared.
    pub(crate) compared: f64,
}

impl ShareInKinds {
    /// The most that the posterior, averaged over kinds, can change (total variation) if the log likelihood
    /// of the intent changes by these numbers (nat) at the two rates, and the kind has this probability.
    ///
    /// A factor f for hypotheses with a share s makes the sum over all of them r = 1 + s (f - 1) times as
    /// great, and moves s (1 - s) |f - 1| / r of their distribution.
    pub(crate) fn greatest_change(self, [own, compared]: [f64; 2], probability: f64) -> f64 {
        let ratio = |share: f64, log: f64| 1.0 + share * libm::expm1(log);
        let within = self.own * (1.0 - self.own) * libm::expm1(own).abs() / ratio(self.own, own);
        let weighted = probability * ratio(self.compared, compared);
        let then = weighted / (weighted + 1.0 - probability);
        probability.max(then) * within + (then - probability).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::ShareInKinds;
    use proptest::prelude::*;

    /// Probabilities in proportion to some weights.
    fn distribution(weights: &[f64]) -> Vec<f64> {
        let sum: f64 = weights.iter().sum();
        weights.iter().map(|weight| weight / sum).collect()
    }

    proptest! {
        /// No change of the first two of six hypotheses of one kind of minds, beside another kind, is greater
        /// than the bound.
        #[test]
        fn no_change_is_greater_than_the_bound(
            own in prop::array::uniform6(0.001..1.0_f64),
            compared in prop::array::uniform6(0.001..1.0_f64),
            other in prop::array::uniform6(0.001..1.0_f64),
            logs in prop::array::uniform2(-8.0..8.0_f64),
            probability in 0.001..1.0_f64,
        ) {
            let moved = |weights: &[f64; 6], log: f64| {
                let mut weights = *weights;
                weights[..2].iter_mut().for_each(|weight| *weight *= log.exp());
                weights
            };
            let share = |weights: &[f64; 6]| distribution(weights)[..2].iter().sum::<f64>();
            let evidence = moved(&compared, logs[1]).iter().sum::<f64>() / compared.iter().sum::<f64>();
            let then = probability * evidence / (probability * evidence + 1.0 - probability);
            let (before, after) = (distribution(&own), distribution(&moved(&own, logs[0])));
            let other = distribution(&other);
            let change = |k: usize| {
                let before = probability * before[k] + (1.0 - probability) * other[k];
                before - then * after[k] - (1.0 - then) * other[k]
            };
            let change = (0..6).map(|k| change(k).abs()).sum::<f64>() / 2.0;
            let shares = ShareInKinds { own: share(&own), compared: share(&compared) };
            prop_assert!(change <= shares.greatest_change(logs, probability) + 1e-12);
        }
    }
}
