//! Intents of both agents, weighed together.

use crate::Hypothesis;
use phase_model::{AGENT_COUNT, AgentId, Attitude, Intent, Strength};

/// Intents of an agent with ln P(motion | intent) of its part of the motion (nat).
pub type WeightedIntents = Vec<(Intent, f64)>;

/// ln P(Y) P(motion | Y) of every hypothesis in which at most one agent is social: its prior times the
/// likelihoods of both agents' intents. Both agents decide at the same time from the same state, so that
/// these are independent. `goals` is the number of goals that an agent can have.
/// [`Posterior::new`](crate::Posterior::new) makes a posterior of it, or, of those of several kinds of minds
/// one after the other, their average with an even prior.
#[must_use]
pub fn joint_logs(
    weighted_intents: &[WeightedIntents; AGENT_COUNT],
    strengths: [Strength; AGENT_COUNT],
    goals: usize,
) -> Vec<(Hypothesis, f64)> {
    let weigh = |hypothesis: Hypothesis, log: f64| (hypothesis, log + hypothesis.log_prior(goals));
    let neutral = |agent: AgentId| {
        weighted_intents[agent].iter().filter(|(intent, _)| intent.attitude == Attitude::Neutral)
    };
    let mut hypotheses = Vec::new();
    for (first, first_log) in neutral(AgentId::ZERO) {
        for (second, second_log) in neutral(AgentId::ONE) {
            let hypothesis = Hypothesis::of_intent(*first, AgentId::ZERO, second.goal, strengths);
            hypotheses.push(weigh(hypothesis, first_log + second_log));
        }
    }
    for (social, intents) in AgentId::ALL.into_iter().zip(weighted_intents) {
        for (intent, log) in intents.iter().filter(|(intent, _)| intent.attitude != Attitude::Neutral) {
            let other = neutral(social.other()).find(|(other, _)| other.goal == intent.goal);
            let Some((_, other_log)) = other else { continue };
            let hypothesis = Hypothesis::of_intent(*intent, social, intent.goal, strengths);
            hypotheses.push(weigh(hypothesis, log + other_log));
        }
    }
    hypotheses
}
