//! Intents that each agent takes the other to have, from the observations that it can have made.

use crate::{
    Hypothesis, Inference, KnowledgeOfGoal, PreparedEvent, beliefs::EstimatedBeliefs, guide::intent_of,
    uninformed::actions_of,
};
use phase_model::{AGENT_COUNT, AgentId, Attitude, Awareness, Intent, Level};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The levels at which beliefs differ: level 2 learns as level 1 does.
const LEARNERS: [Level; 2] = [Level::Zero, Level::One];

/// Prior probabilities of what a neutral agent knows of the other's goal; how it acts hardly tells that.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct NeutralKnowledge {
    /// Probability that it knows the goal, 0 to 1.
    pub knows: f64,
    /// Probability that one that does not know it does not infer it, either, 0 to 1.
    pub level_zero: f64,
}

/// As fitted by `cargo xtask fit-intents` to 40 training events of `phase-minds`. No particles of level 0
/// ever agree on an intent, so that its beliefs are not asked about.
const FITTED: NeutralKnowledge = NeutralKnowledge { knows: 0.25, level_zero: 0.0 };

impl Default for NeutralKnowledge {
    fn default() -> Self {
        FITTED
    }
}

/// Intents that an agent takes the other to have, with their probabilities.
type Shares = Vec<(Intent, f64)>;

/// The intents that an agent takes the other to have after a step, by what it knows.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
struct OfAgent {
    /// If the agent helps or hinders, or all agents are taken to know; weighed already.
    settled: Shares,
    /// If the agent is neutral and knows the other's goal.
    knowing: Shares,
    /// If it is neutral and does not know the goal, at each level.
    unknowing: [Shares; LEARNERS.len()],
}

/// The evidence in the motion of an event about the intents that its agents take each other to have;
/// [`intents`](Self::intents) averages over what neutral agents know.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct IntentBeliefEvidence(Vec<[OfAgent; AGENT_COUNT]>);

impl IntentBeliefEvidence {
    /// The intents that each agent takes the other to have after each of the steps.
    #[must_use]
    pub fn intents(
        &self,
        &NeutralKnowledge { knows, level_zero }: &NeutralKnowledge,
    ) -> Vec<[BTreeMap<Intent, f64>; AGENT_COUNT]> {
        let weights = [knows, (1.0 - knows) * level_zero, (1.0 - knows) * (1.0 - level_zero)];
        let mean = |OfAgent { settled, knowing, unknowing: [zero, one] }: &OfAgent| {
            let mut all = BTreeMap::new();
            let parts = [(1.0, settled)].into_iter().chain(weights.into_iter().zip([knowing, zero, one]));
            for (weight, shares) in parts.filter(|(weight, _)| *weight > 0.0) {
                shares.iter().for_each(|(intent, share)| *all.entry(*intent).or_default() += weight * share);
            }
            all
        };
        self.0.iter().map(|agents| AgentId::ALL.map(|agent| mean(&agents[agent]))).collect()
    }
}

/// The intents that each agent takes the other to have after some steps. One that knows the other's goal
/// takes it to have its intent; another has the suppositions of its particles. Without latent knowledge all
/// agents know it.
pub(crate) fn evidence(
    prepared: &PreparedEvent,
    inference: &Inference,
    steps: &[usize],
) -> IntentBeliefEvidence {
    let mut all: Vec<[OfAgent; AGENT_COUNT]> = steps.iter().map(|_| Default::default()).collect();
    for agent in AgentId::ALL {
        let knowledge = inference.knowledge.as_ref().map(|knowledge| &knowledge[agent]);
        for (hypothesis, weight) in &inference.posterior.hypotheses {
            let intent = intent_of(hypothesis, agent.other());
            let is_open = knowledge.is_some() && hypothesis.attitudes[agent] == Attitude::Neutral;
            let knows = knowledge.filter(|_| !is_open).map_or(1.0, |knowledge| knowledge.knows);
            for of in &mut all {
                let OfAgent { settled, knowing, .. } = &mut of[agent];
                if is_open { knowing } else { settled }.push((intent, weight * knows));
            }
        }
        for (hypothesis, level, weight) in unknowing(inference, agent, knowledge) {
            let is_neutral = hypothesis.attitudes[agent] == Attitude::Neutral;
            let beliefs = beliefs_of(prepared, hypothesis, agent, level);
            for (&step, of) in steps.iter().zip(&mut all) {
                let OfAgent { settled, unknowing: [zero, one], .. } = &mut of[agent];
                let shares = match (is_neutral, level) {
                    (false, _) => settled,
                    (true, Level::Zero) => zero,
                    (true, Level::One | Level::Two) => one,
                };
                let suppositions = beliefs.after(step).suppositions();
                let share = weight / suppositions.len().max(1) as f64;
                shares.extend(suppositions.iter().map(|supposition| (supposition.intent, share)));
            }
        }
    }
    all.iter_mut().flatten().for_each(OfAgent::merge);
    IntentBeliefEvidence(all)
}

impl OfAgent {
    /// Adds up the probabilities of each intent.
    fn merge(&mut self) {
        let [zero, one] = &mut self.unknowing;
        for shares in [&mut self.settled, &mut self.knowing, zero, one] {
            let mut sums: BTreeMap<Intent, f64> = BTreeMap::new();
            shares.iter().for_each(|(intent, share)| *sums.entry(*intent).or_default() += share);
            *shares = sums.into_iter().collect();
        }
    }
}

/// The likeliest hypotheses in which an agent is neutral, and in which it is not, at each level at which it
/// may lack knowledge, with the probability of that; for a neutral agent with that of being neutral.
fn unknowing<'a>(
    inference: &'a Inference,
    agent: AgentId,
    knowledge: Option<&KnowledgeOfGoal>,
) -> Vec<(&'a Hypothesis, Level, f64)> {
    let Some(knowledge) = knowledge else { return Vec::new() };
    let hypotheses = &inference.posterior.hypotheses;
    let mut all = Vec::new();
    for neutral in [true, false] {
        let is_such = |it: &&(Hypothesis, f64)| (it.0.attitudes[agent] == Attitude::Neutral) == neutral;
        let weight: f64 = hypotheses.iter().filter(is_such).map(|(_, weight)| weight).sum();
        let Some((likeliest, _)) = hypotheses.iter().find(is_such) else { continue };
        let [zero, one, two] = knowledge.levels;
        let shares = if neutral { [1.0; LEARNERS.len()] } else { [zero, one + two] };
        let levels = LEARNERS.into_iter().zip(shares);
        all.extend(levels.map(|(level, share)| (likeliest, level, weight * share)));
    }
    all.retain(|(.., weight)| *weight > 0.0);
    all
}

/// The beliefs of an agent of a level that does not know the other's goal.
fn beliefs_of(
    prepared: &PreparedEvent,
    hypothesis: &Hypothesis,
    agent: AgentId,
    level: Level,
) -> EstimatedBeliefs {
    let mut scene = hypothesis.scene(prepared.observed());
    scene.agents[agent].awareness = Awareness::ignorant(level);
    let motion = prepared.motion();
    let actions = actions_of(motion, agent);
    let minds = &prepared.agents().minds;
    EstimatedBeliefs::in_scene(&scene, &motion.states, &actions, agent, minds, prepared.seed())
}
