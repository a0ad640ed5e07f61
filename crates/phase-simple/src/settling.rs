//! The change that a closer look at an intent can make.

use crate::{
    Hypothesis, Intent,
    answer::{KindEvidence, log_evidence, probabilities},
    guide::intent_of,
};
use phase_model::{AGENT_COUNT, AgentId};
use std::collections::BTreeSet;

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
    pub(crate) fn greatest_change(self, logs: [f64; 2], probability: f64) -> f64 {
        let Moved { ratio, probability: then } = self.moved(logs, probability);
        let within = self.own * (1.0 - self.own) * libm::expm1(logs[0]).abs() / ratio;
        probability.max(then) * within + (then - probability).abs()
    }

    fn moved(self, [own, compared]: [f64; 2], probability: f64) -> Moved {
        let ratio = |share: f64, log: f64| 1.0 + share * libm::expm1(log);
        let weighted = probability * ratio(self.compared, compared);
        Moved { ratio: ratio(self.own, own), probability: weighted / (weighted + 1.0 - probability) }
    }
}

/// The state of a kind of minds after the log likelihood of an intent has changed.
struct Moved {
    /// The sum over its hypotheses, by its former value.
    ratio: f64,
    /// The kind's probability.
    probability: f64,
}

/// The posterior of some kinds of minds, as far as closer looks can change it.
pub(crate) struct Settling {
    /// All hypotheses; the numbers below are by their places.
    hypotheses: Vec<Hypothesis>,
    kinds: Vec<SettlingKind>,
}

/// One of these kinds of minds.
struct SettlingKind {
    probability: f64,
    /// The probability of each hypothesis if the kind is that of the agents.
    hypotheses: Vec<f64>,
    /// Whether each was simulated. Others keep their probability.
    simulated: Vec<bool>,
}

impl Settling {
    /// The posterior from what each kind finds when some intents of each agent were simulated.
    pub(crate) fn new(kinds: &[KindEvidence], simulated: &[[Vec<Intent>; AGENT_COUNT]]) -> Self {
        let all: BTreeSet<Hypothesis> = kinds.iter().flat_map(|kind| &kind.joint).map(|it| it.0).collect();
        let hypotheses: Vec<Hypothesis> = all.into_iter().collect();
        let of_kind =
            |((kind, simulated), probability): ((&KindEvidence, &[Vec<Intent>; AGENT_COUNT]), _)| {
                let sum = log_evidence(&kind.joint);
                let mut probabilities = vec![0.0; hypotheses.len()];
                for (hypothesis, log) in &kind.joint {
                    if let Ok(place) = hypotheses.binary_search(hypothesis) {
                        probabilities[place] += libm::exp(log - sum);
                    }
                }
                let is_simulated = |hypothesis: &Hypothesis| {
                    AgentId::ALL
                        .into_iter()
                        .all(|agent| simulated[agent].contains(&intent_of(hypothesis, agent)))
                };
                SettlingKind {
                    probability,
                    hypotheses: probabilities,
                    simulated: hypotheses.iter().map(is_simulated).collect(),
                }
            };
        let kinds = kinds.iter().zip(simulated).zip(probabilities(kinds)).map(of_kind).collect();
        Self { hypotheses, kinds }
    }

    /// The probability of a kind.
    pub(crate) fn probability(&self, kind: usize) -> f64 {
        self.kinds[kind].probability
    }

    /// The change of the posterior, averaged over kinds (total variation), if the log likelihood of an
    /// intent of an agent under a kind, which has this share, changes by these numbers (nat) at its own lapse
    /// rate and at that at which kinds are compared.
    pub(crate) fn change(
        &self,
        kind: usize,
        agent: AgentId,
        intent: Intent,
        share: ShareInKinds,
        logs: [f64; 2],
    ) -> f64 {
        let of_kind = &self.kinds[kind];
        let before = of_kind.probability;
        let Moved { ratio, probability: then } = share.moved(logs, before);
        let others = if before < 1.0 { (1.0 - then) / (1.0 - before) - 1.0 } else { 0.0 };
        let rest = 1.0 / ratio;
        let factor = libm::exp(logs[0]) / ratio;
        let mut change = 0.0;
        for (place, hypothesis) in self.hypotheses.iter().enumerate() {
            let factor = match of_kind.simulated[place] {
                false => 1.0,
                true if intent_of(hypothesis, agent) == intent => factor,
                true => rest,
            };
            let mut difference = (then * factor - before) * of_kind.hypotheses[place];
            for (_, other) in self.kinds.iter().enumerate().filter(|(other, _)| *other != kind) {
                difference += others * other.probability * other.hypotheses[place];
            }
            change += difference.abs();
        }
        change / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::{Settling, ShareInKinds, shares};
    use crate::{
        Guidance, Intent,
        answer::{KindEvidence, log_evidence, mixture},
        guide::Guess,
        intent::{WeightedIntents, joint_logs},
    };
    use phase_model::{AGENT_COUNT, AgentId, Strength};
    use proptest::prelude::*;

    const STRENGTHS: [Strength; AGENT_COUNT] = [Strength::Weak, Strength::Mighty];
    const GOALS: usize = 14;

    /// Every so many intents of each agent with these logarithms, one after the other.
    fn weighted(every: usize, logs: &[f64]) -> [WeightedIntents; AGENT_COUNT] {
        let mut logs = logs.iter().cycle();
        AgentId::ALL.map(|agent| {
            let intents = Intent::all(agent, 2).into_iter().step_by(every);
            intents.zip(&mut logs).map(|(intent, log)| (intent, *log)).collect()
        })
    }

    proptest! {
        /// The change is that of two posteriors that are computed one after the other, and not greater than
        /// the bound.
        #[test]
        fn a_change_is_that_of_the_whole_posterior(
            logs in prop::collection::vec(-6.0..0.0_f64, 100..120),
            guessed in prop::option::of(prop::collection::vec(-6.0..0.0_f64, 90)),
            changed in (0..2_usize, 0..2_u8, 0..10_usize),
            change in prop::array::uniform2(-3.0..3.0_f64),
        ) {
            let guess = |logs: &[f64]| Guess::new(&Guidance::default(), weighted(1, logs), 2, STRENGTHS);
            let guess = guessed.as_deref().map(guess);
            // By kind, and by rate.
            let intents: Vec<[_; 2]> =
                (0..2).map(|kind| [0, 1].map(|rate| weighted(4, &logs[40 * kind + 20 * rate..]))).collect();
            let evidence = |intents: &[[WeightedIntents; AGENT_COUNT]; 2]| {
                let [joint, compared] = intents.each_ref().map(|of_rate| {
                    let joint = joint_logs(of_rate, STRENGTHS, GOALS);
                    guess.as_ref().map_or(joint.clone(), |guess| guess.complete(joint))
                });
                KindEvidence { joint, log_evidence: log_evidence(&compared) }
            };
            let before: Vec<KindEvidence> = intents.iter().map(evidence).collect();
            let named = |it: &WeightedIntents| it.iter().map(|it| it.0).collect();
            let simulated: Vec<_> = intents.iter().map(|[own, _]| own.each_ref().map(named)).collect();
            let settling = Settling::new(&before, &simulated);

            let (kind, agent, place) = (changed.0, AgentId::ALL[usize::from(changed.1)], changed.2);
            let intent = intents[kind][0][agent][place].0;
            let share = |rate: usize| {
                let joint = joint_logs(&intents[kind][rate], STRENGTHS, GOALS);
                shares(&joint, agent, core::iter::once(intent))[0]
            };
            let share = ShareInKinds { own: share(0), compared: share(1) };
            let found = settling.change(kind, agent, intent, share, change);

            let mut after = intents.clone();
            for (of_rate, change) in after[kind].iter_mut().zip(change) {
                of_rate[agent][place].1 += change;
            }
            let after: Vec<KindEvidence> = after.iter().map(evidence).collect();
            let expected = mixture(&before).0.total_variation(&mixture(&after).0);
            prop_assert!((found - expected).abs() < 1e-12, "{found} for {expected}");
            prop_assert!(found <= share.greatest_change(change, settling.probability(kind)) + 1e-12);
        }
    }
}
