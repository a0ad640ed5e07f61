//! The intent network as a guide of inverse planning: which hypotheses are worth simulating, and how much its
//! guess counts.
//!
//! The posterior is a product of experts, P(Y | S) ∝ P(Y) Q(Y | S)^a P(S | Y), over the hypotheses that the
//! guide leaves. What it leaves out keeps the probability that the guide gives it.

use crate::{
    Hypothesis, Intent, IntentNetwork, Posterior,
    answer::log_evidence,
    intent::{WeightedIntents, joint_logs},
    physical_goals,
};
use phase_model::{AGENT_COUNT, AgentId, Attitude, Goal, Strength};
use serde::{Deserialize, Serialize};
use std::{
    collections::{BTreeMap, BTreeSet},
    sync::Arc,
};

/// The weight of a network's guess in inverse planning (docs/explanation/simple.md).
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Guidance {
    /// a, the exponent of the network's guess, 0 to 1.
    pub exponent: f64,
    /// Share of the probability of Q whose hypotheses are simulated, 0 to 1.
    pub mass: f64,
}

impl Default for Guidance {
    fn default() -> Self {
        Self { exponent: 0.7, mass: 0.95 }
    }
}

/// A network that guides inverse planning: only the intents that it holds for likely are simulated, and its
/// guess enters the posterior.
#[derive(Clone, Debug)]
pub struct Guide {
    /// The network, which observers share.
    pub network: Arc<IntentNetwork>,
    /// The weight of its guess.
    pub guidance: Guidance,
}

/// The guide's guess at one event.
#[derive(Clone, Debug)]
pub(crate) struct Guess {
    /// a ln Q of every intent.
    intents: [WeightedIntents; AGENT_COUNT],
    /// Q, likeliest first.
    posterior: Posterior,
    /// The place of each hypothesis in it.
    places: BTreeMap<Hypothesis, usize>,
    /// The intents worth simulating.
    kept: [BTreeSet<Intent>; AGENT_COUNT],
}

impl Guess {
    /// From ln Q of every intent in an event with so many objects, whose agents have these strengths.
    pub(crate) fn new(
        guidance: &Guidance,
        mut intents: [WeightedIntents; AGENT_COUNT],
        objects: usize,
        strengths: [Strength; AGENT_COUNT],
    ) -> Self {
        let Guidance { exponent, mass } = *guidance;
        let goals = physical_goals(AgentId::ZERO, objects).len();
        let posterior = Posterior::new(joint_logs(&intents, strengths, goals));
        intents.iter_mut().flatten().for_each(|(_, log)| *log *= exponent);
        let mut kept: [BTreeSet<Intent>; AGENT_COUNT] = Default::default();
        let mut covered = 0.0;
        for (hypothesis, weight) in &posterior.hypotheses {
            for (agent, kept) in AgentId::ALL.into_iter().zip(&mut kept) {
                kept.insert(intent_of(hypothesis, agent));
            }
            covered += weight;
            if covered >= mass {
                break;
            }
        }
        let hypotheses = posterior.hypotheses.iter().enumerate();
        let places = hypotheses.map(|(place, (hypothesis, _))| (*hypothesis, place)).collect();
        Self { intents, posterior, places, kept }
    }

    /// The intents that are worth simulating, likeliest first.
    pub(crate) fn kept(&self) -> Vec<(AgentId, Intent)> {
        let of = |agent: AgentId| self.kept[agent].iter().map(move |&intent| (agent, intent));
        let mut kept: Vec<_> = AgentId::ALL.into_iter().flat_map(of).collect();
        kept.sort_by(|a, b| self.log(b.0, b.1).total_cmp(&self.log(a.0, a.1)));
        kept
    }

    /// Q of every hypothesis.
    pub(crate) const fn posterior(&self) -> &Posterior {
        &self.posterior
    }

    /// The likeliest goals.
    pub(crate) fn goals(&self) -> Option<[Goal; AGENT_COUNT]> {
        self.posterior.hypotheses.first().map(|(likeliest, _)| likeliest.goals)
    }

    /// a ln Q of an intent of an agent.
    pub(crate) fn log(&self, agent: AgentId, intent: Intent) -> f64 {
        let known = self.intents[agent].iter().find(|(other, _)| *other == intent);
        known.map_or(f64::NEG_INFINITY, |(_, log)| *log)
    }

    /// Adds the hypotheses that were not simulated to ln P(Y, motion) of those that were, such that the
    /// former keep the share that the guide gives them. If none was, the guide alone answers.
    pub(crate) fn complete(&self, mut joint: Vec<(Hypothesis, f64)>) -> Vec<(Hypothesis, f64)> {
        let mut simulated = vec![false; self.posterior.hypotheses.len()];
        for (hypothesis, _) in &joint {
            if let Some(&place) = self.places.get(hypothesis) {
                simulated[place] = true;
            }
        }
        let all = || self.posterior.hypotheses.iter().zip(&simulated);
        let others = || all().filter(|(_, simulated)| !**simulated).map(|(it, _)| it);
        let share: f64 = others().map(|(_, weight)| weight).sum();
        if joint.is_empty() {
            return self.posterior.hypotheses.iter().map(|&(it, weight)| (it, libm::log(weight))).collect();
        }
        let scale = log_evidence(&joint) - libm::log((1.0 - share).max(f64::MIN_POSITIVE));
        let rest: Vec<_> = others()
            .filter(|(_, weight)| *weight > 0.0)
            .map(|(hypothesis, weight)| (*hypothesis, libm::log(*weight) + scale))
            .collect();
        joint.extend(rest);
        joint
    }
}

/// The intent that a hypothesis ascribes to an agent.
pub(crate) fn intent_of(hypothesis: &Hypothesis, agent: AgentId) -> Intent {
    let attitude = hypothesis.attitudes[agent];
    let owner = if attitude == Attitude::Neutral { agent } else { agent.other() };
    Intent { attitude, goal: hypothesis.goals[owner] }
}

#[cfg(test)]
mod tests {
    use super::{Guess, intent_of};
    use crate::{Guidance, Hypothesis, Intent, Posterior, physical_goals};
    use phase_model::{AGENT_COUNT, AgentId, Attitude, Strength};

    const STRENGTHS: [Strength; AGENT_COUNT] = [Strength::Weak, Strength::Mighty];

    /// A guess in which agent 0 likely helps agent 1 with its first goal.
    fn guess() -> Guess {
        let weigh = |agent: AgentId| {
            let first = physical_goals(AgentId::ONE, 2)[0];
            let likely = |intent: &Intent| intent.goal == first && intent.attitude != Attitude::Hinder;
            let log = |intent: Intent| (intent, if likely(&intent) { 3.0 } else { 0.0 });
            Intent::all(agent, 2).into_iter().map(log).collect()
        };
        Guess::new(&Guidance { exponent: 1.0, mass: 0.0 }, AgentId::ALL.map(weigh), 2, STRENGTHS)
    }

    #[test]
    fn the_intents_of_a_hypothesis_make_it_up() {
        for (hypothesis, _) in guess().posterior.hypotheses {
            let agent = hypothesis.social_agent().unwrap_or(AgentId::ZERO);
            let [own, others] = [agent, agent.other()].map(|agent| intent_of(&hypothesis, agent));
            assert_eq!(Hypothesis::of_intent(own, agent, others.goal, STRENGTHS), hypothesis);
            assert_eq!(others.attitude, Attitude::Neutral);
        }
    }

    /// Whatever is simulated and with whatever result, the rest keeps its share and its proportions.
    #[test]
    fn what_is_left_out_keeps_its_probability() {
        let guess = guess();
        let simulated: Vec<_> = guess.posterior.hypotheses.iter().take(9).map(|it| (it.0, -1000.0)).collect();
        let share: f64 = guess.posterior.hypotheses.iter().skip(9).map(|it| it.1).sum();
        let all = Posterior::new(guess.complete(simulated));
        assert_eq!(all.hypotheses.len(), guess.posterior.hypotheses.len());
        for (hypothesis, weight) in guess.posterior.hypotheses.iter().skip(9) {
            let found = all.hypotheses.iter().find(|it| it.0 == *hypothesis).expect("kept");
            assert!((found.1 - weight).abs() < 1e-12);
        }
        let of_simulated = 1.0 - share;
        assert!((all.hypotheses[0].1 - of_simulated / 9.0).abs() < 1e-12);
    }
}
