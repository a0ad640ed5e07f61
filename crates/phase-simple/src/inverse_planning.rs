//! Inverse planning: the likelihood of each agent's motion under each of its possible intents.
//!
//! Both agents decide at the same time from the same state, so given the states their actions are conditionally
//! independent. P(motion | Y) is therefore a product of one factor per agent, and instead of 14 · 14 + 2 · 28
//! hypotheses it suffices to simulate 42 intents of each agent, with the other replaying its inferred actions.

use crate::{
    Hypothesis, IntentEvidence, InversePlanningSettings, Posterior, Proposal,
    choice::{self, ByChoice},
    generative::PreparedEvent,
    guide::{Guess, Guide},
    intent::{Intent, WeightedIntents, joint_logs},
    strength::UniformStrength,
};
use core::ops::ControlFlow;
use phase_model::{AGENT_COUNT, AgentId, Attitude, Goal, Strength};
use phase_pomcp::PomcpError;

/// Refinement passes: how often the intents are re-evaluated with an updated goal of the other agent.
const REFINEMENT_PASSES: usize = 2;

/// ln P(Y) P(motion | Y) of every hypothesis, with the strengths inferred from the physics; `None` if `tick`, which
/// is called once per intent, cancelled it. A guide adds its guess, and restricts the simulations to the intents that it leaves.
///
/// # Errors
///
/// Invalid parameters of the agents' search.
pub(crate) fn weighted_hypotheses(
    prepared: &PreparedEvent<'_>,
    settings: &InversePlanningSettings,
    gamma: f64,
    guide: Option<&Guide<'_>>,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Vec<(Hypothesis, f64)>>, PomcpError> {
    let observed = prepared.observed();
    let objects = observed.object_sizes().len();
    let evidence = EventEvidence {
        prepared,
        settings,
        action_likelihoods: choice::action_likelihoods(prepared, settings.tolerance),
        strengths: prepared.motion().strengths(),
    };
    let cue = Proposal::new(observed, 0..=observed.steps(), gamma, &UniformStrength);
    let guess = guide.map(|guide| Guess::new(guide, observed, evidence.strengths));
    // The goal that each agent attributes to the other if it is not social.
    let likeliest = guess.as_ref().and_then(Guess::goals);
    let mut assumed_goals: [Goal; AGENT_COUNT] =
        likeliest.unwrap_or_else(|| AgentId::ALL.map(|agent| cue.most_likely_goal(agent)));
    let log_guess = |agent, intent| guess.as_ref().map_or(0.0, |guess| guess.log(agent, intent));
    let mut weighted_intents: [WeightedIntents; AGENT_COUNT] = [Vec::new(), Vec::new()];
    for (agent, weighted_intents) in AgentId::ALL.into_iter().zip(&mut weighted_intents) {
        let intents =
            guess.as_ref().map_or_else(|| Intent::all(agent, objects), |guess| guess.kept(agent).collect());
        for intent in intents {
            if tick().is_break() {
                return Ok(None);
            }
            let log = evidence.log_likelihood(agent, &intent, assumed_goals[agent.other()])?;
            weighted_intents.push((intent, log + log_guess(agent, intent)));
        }
    }
    let goals = cue.goals(AgentId::ZERO).len();
    let mut joint = joint_logs(&weighted_intents, evidence.strengths, goals);
    for _ in 0..REFINEMENT_PASSES {
        let likeliest = Posterior::new(joint.iter().copied())
            .hypotheses
            .first()
            .map_or(assumed_goals, |(best, _)| best.goals);
        for (agent, weighted_intents) in AgentId::ALL.into_iter().zip(&mut weighted_intents) {
            let other = agent.other();
            if likeliest[other] == assumed_goals[other] {
                continue;
            }
            for (intent, log) in
                weighted_intents.iter_mut().filter(|(intent, _)| intent.attitude == Attitude::Neutral)
            {
                if tick().is_break() {
                    return Ok(None);
                }
                *log = evidence.log_likelihood(agent, intent, likeliest[other])? + log_guess(agent, *intent);
            }
        }
        if likeliest == assumed_goals {
            break;
        }
        assumed_goals = likeliest;
        joint = joint_logs(&weighted_intents, evidence.strengths, goals);
    }
    Ok(Some(match &guess {
        Some(guess) => guess.complete(joint),
        None => joint,
    }))
}

/// The data from which intents are weighted.
struct EventEvidence<'a> {
    prepared: &'a PreparedEvent<'a>,
    settings: &'a InversePlanningSettings,
    action_likelihoods: Vec<[ByChoice; AGENT_COUNT]>,
    strengths: [Strength; AGENT_COUNT],
}

impl EventEvidence<'_> {
    /// ln P(motion | intent) of an agent's part of the motion, the other pursuing `others`.
    fn log_likelihood(&self, agent: AgentId, intent: &Intent, others: Goal) -> Result<f64, PomcpError> {
        let evidence = IntentEvidence::of(
            self.prepared,
            &self.action_likelihoods,
            agent,
            *intent,
            others,
            self.strengths,
            self.settings.resync_interval,
        )?;
        Ok(evidence.log_likelihood(self.settings))
    }
}
