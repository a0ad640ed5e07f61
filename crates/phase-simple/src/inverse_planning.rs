//! Inverse planning: the likelihood of each agent's motion under each of its possible intents.
//!
//! Both agents decide at the same time from the same state, so given the states their actions are
//! conditionally independent. P(motion | Y) is therefore a product of one factor per agent, and instead of 14
//! · 14 + 2 · 28 hypotheses it suffices to simulate 42 intents of each agent, with the other replaying its
//! inferred actions.
//!
//! All evidence is kept by what it is about and catches up with the event when it is asked for, so that an
//! event can be followed while it is watched, and the answer is the same as if it had been seen at once.

use crate::{
    Hypothesis, Intent, IntentEvidence, InversePlanningSettings, Posterior,
    evidence::{ActionLikelihoods, Budget},
    generative::PreparedEvent,
    guide::Guess,
    intent::{WeightedIntents, joint_logs},
    physical_goals,
};
use core::ops::ControlFlow;
use phase_model::{AGENT_COUNT, AgentId, Attitude, Goal, Strength};
use phase_pomcp::PomcpError;
use std::collections::BTreeMap;

/// Refinement passes: how often the intents are re-evaluated with an updated goal of the other agent.
const REFINEMENT_PASSES: usize = 2;

/// Whose intent it is, and the other's goal if the intent does not say.
type Key = (AgentId, Intent, Option<Goal>);

/// The evidence on an event for one kind of minds.
#[derive(Debug)]
pub(crate) struct InversePlanner {
    pub(crate) prepared: PreparedEvent,
    settings: InversePlanningSettings,
    strengths: [Strength; AGENT_COUNT],
    likelihoods: ActionLikelihoods,
    evidence: BTreeMap<Key, IntentEvidence>,
    /// The evidence that the last answer used.
    asked: [Vec<Key>; AGENT_COUNT],
}

impl InversePlanner {
    pub(crate) fn new(prepared: PreparedEvent, settings: &InversePlanningSettings) -> Self {
        Self {
            strengths: prepared.motion().strengths(),
            prepared,
            settings: *settings,
            likelihoods: ActionLikelihoods::new(settings),
            evidence: BTreeMap::new(),
            asked: [Vec::new(), Vec::new()],
        }
    }

    /// Drops the evidence on all but some first rows of an event that was followed, which are explained as
    /// before.
    pub(crate) fn forget(&mut self, rows: usize) {
        let strengths = self.prepared.motion().strengths();
        if strengths == self.strengths {
            self.evidence.values_mut().for_each(|evidence| evidence.forget(&self.likelihoods, rows));
            self.likelihoods.forget(rows);
        } else {
            *self = Self::new(self.prepared.clone(), &self.settings);
        }
    }

    /// Catches up with the event, as far as all intents have it in common.
    pub(crate) fn follow(&mut self) {
        self.likelihoods.follow(&self.prepared);
    }

    /// Catches up with an intent of an agent, the other pursuing `others`. Whether it could, within the
    /// budget.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub(crate) fn catch_up(
        &mut self,
        agent: AgentId,
        intent: Intent,
        others: Goal,
        budget: &mut Budget,
    ) -> Result<bool, PomcpError> {
        Ok(self.log_likelihood(agent, intent, others, budget)?.is_some())
    }

    /// Simulates these intents, as far as the budget suffices, with the strengths inferred from the physics;
    /// whether `tick`, which is called about once per intent, let it. `assumed` are the goals that neutral
    /// agents first attribute to each other; the likeliest ones, given what a guide guesses, take their
    /// place. [`InversePlanner::weighted_after`] has the result.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub(crate) fn simulate(
        &mut self,
        intents: &[(AgentId, Intent)],
        assumed: [Goal; AGENT_COUNT],
        guess: Option<&Guess>,
        budget: &mut Budget,
        tick: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<bool, PomcpError> {
        let log_guess = |agent, intent| guess.map_or(0.0, |guess| guess.log(agent, intent));
        let mut weighted_intents: [WeightedIntents; AGENT_COUNT] = [Vec::new(), Vec::new()];
        self.asked = [Vec::new(), Vec::new()];
        for &(agent, intent) in intents {
            if tick().is_break() {
                return Ok(false);
            }
            let others = assumed[agent.other()];
            let Some(log) = self.log_likelihood(agent, intent, others, budget)? else { continue };
            weighted_intents[agent].push((intent, log + log_guess(agent, intent)));
            self.asked[agent].push(key(agent, intent, others));
        }
        let mut assumed_goals = assumed;
        let goals = physical_goals(AgentId::ZERO, self.prepared.observed().object_sizes().len()).len();
        let mut joint = joint_logs(&weighted_intents, self.strengths, goals);
        for _ in 0..REFINEMENT_PASSES {
            let likeliest = Posterior::new(joint.iter().copied())
                .hypotheses
                .first()
                .map_or(assumed_goals, |(best, _)| best.goals);
            for (agent, weighted_intents) in AgentId::ALL.into_iter().zip(&mut weighted_intents) {
                let others = likeliest[agent.other()];
                if others == assumed_goals[agent.other()] {
                    continue;
                }
                for (place, (intent, log)) in weighted_intents.iter_mut().enumerate() {
                    if intent.attitude != Attitude::Neutral {
                        continue;
                    }
                    if tick().is_break() {
                        return Ok(false);
                    }
                    let refined = self.log_likelihood(agent, *intent, others, budget)?;
                    if let Some(refined) = refined {
                        *log = refined + log_guess(agent, *intent);
                        self.asked[agent][place] = key(agent, *intent, others);
                    }
                }
            }
            if likeliest == assumed_goals {
                break;
            }
            assumed_goals = likeliest;
            joint = joint_logs(&weighted_intents, self.strengths, goals);
        }
        Ok(true)
    }

    /// Number of decisions that were looked at.
    pub(crate) fn decisions(&self) -> usize {
        self.likelihoods.decisions()
    }

    /// The row after which so many decisions are known.
    pub(crate) fn row_after(&self, decisions: usize) -> usize {
        self.likelihoods.row_after(decisions)
    }

    /// The last answer as it would have been after so many decisions, when the guide said `guess`: ln P(Y)
    /// P(motion | Y) of every hypothesis, those that were not simulated included, at the planner's own lapse
    /// rate or another.
    pub(crate) fn weighted_after(
        &self,
        decisions: usize,
        guess: Option<&Guess>,
        lapse_rate: Option<f64>,
    ) -> Vec<(Hypothesis, f64)> {
        let lapse_rate = lapse_rate.unwrap_or(self.settings.lapse_rate);
        let settings = InversePlanningSettings { lapse_rate, ..self.settings };
        let weighted_intents: [WeightedIntents; AGENT_COUNT] = AgentId::ALL.map(|agent| {
            let weigh = |key: &Key| {
                let log = self.evidence.get(key).map_or(0.0, |it| it.log_likelihood_of(decisions, &settings));
                (key.1, log + guess.map_or(0.0, |guess| guess.log(agent, key.1)))
            };
            self.asked[agent].iter().map(weigh).collect()
        });
        let goals = physical_goals(AgentId::ZERO, self.prepared.observed().object_sizes().len()).len();
        let joint = joint_logs(&weighted_intents, self.strengths, goals);
        match guess {
            Some(guess) => guess.complete(joint),
            None => joint,
        }
    }

    /// ln P(motion | intent) of an agent's part of the motion, the other pursuing `others`; `None` if the
    /// budget does not suffice.
    fn log_likelihood(
        &mut self,
        agent: AgentId,
        intent: Intent,
        others: Goal,
        budget: &mut Budget,
    ) -> Result<Option<f64>, PomcpError> {
        let key = key(agent, intent, others);
        if !self.evidence.contains_key(&key) {
            let evidence = IntentEvidence::new(&self.prepared, agent, intent, others, self.strengths)?;
            self.evidence.insert(key, evidence);
        }
        let Some(evidence) = self.evidence.get_mut(&key) else { return Ok(None) };
        let known = evidence.follow(&self.prepared, &self.likelihoods, budget)?;
        Ok(known.then(|| evidence.log_likelihood(&self.settings)))
    }
}

/// The key of the evidence on an intent, which depends on the other's goal only if the agent is not social.
fn key(agent: AgentId, intent: Intent, others: Goal) -> Key {
    (agent, intent, (intent.attitude == Attitude::Neutral).then_some(others))
}
