//! Inverse planning: the likelihood of each agent's motion under each of its possible intents.
//!
//! Both agents decide at the same time from the same state, so given the states their actions are conditionally
//! independent. P(motion | Y) is therefore a product of one factor per agent, and instead of 14 · 14 + 2 · 28
//! hypotheses it suffices to simulate 42 intents of each agent, with the other replaying its inferred actions.

use crate::{
    Hypothesis, IntentEvidence, InversePlanningSettings, Posterior, Proposal,
    choice::{self, ByChoice},
    generative::PreparedEvent,
    intent::{Intent, WeightedIntents, joint_logs},
    strength::UniformStrength,
};
use core::ops::ControlFlow;
use phase_model::{AGENT_COUNT, AgentId, Attitude, Goal, Strength};
use phase_pomcp::PomcpError;

/// Refinement passes: how often the intents are re-evaluated with an updated goal of the other agent.
const REFINEMENT_PASSES: usize = 2;

/// ln P(Y) P(motion | Y) of every hypothesis, with the strengths inferred from the physics; `None` if `tick`, which
/// is called once per intent, cancelled it.
///
/// # Errors
///
/// Invalid parameters of the agents' search.
pub(crate) fn weighted_hypotheses(
    prepared: &PreparedEvent<'_>,
    settings: &InversePlanningSettings,
    gamma: f64,
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
    // The goal that each agent attributes to the other if it is not social.
    let mut assumed_goals: [Goal; AGENT_COUNT] = AgentId::ALL.map(|agent| cue.most_likely_goal(agent));
    let mut weighted_intents: [WeightedIntents; AGENT_COUNT] = [Vec::new(), Vec::new()];
    for (agent, weighted_intents) in AgentId::ALL.into_iter().zip(&mut weighted_intents) {
        for intent in Intent::all(agent, objects) {
            if tick().is_break() {
                return Ok(None);
            }
            weighted_intents
                .push((intent, evidence.log_likelihood(agent, &intent, assumed_goals[agent.other()])?));
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
                *log = evidence.log_likelihood(agent, intent, likeliest[other])?;
            }
        }
        if likeliest == assumed_goals {
            break;
        }
        assumed_goals = likeliest;
        joint = joint_logs(&weighted_intents, evidence.strengths, goals);
    }
    Ok(Some(joint))
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
