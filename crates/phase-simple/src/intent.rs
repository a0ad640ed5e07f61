//! Intents: the part of a hypothesis that concerns one agent.

use crate::{Hypothesis, hypothesis::physical_goals};
use phase_model::{AGENT_COUNT, AgentId, Attitude, Goal, Strength};

/// Intents of an agent with ln P(motion | intent) of its part of the motion (nat).
pub type WeightedIntents = Vec<(Intent, f64)>;

/// One agent's intent: its own goal, or helping or hindering the other with one of the other's goals.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Intent {
    /// α towards the other.
    pub attitude: Attitude,
    /// The agent's own goal if it is neutral, otherwise the other's.
    pub goal: Goal,
}

impl Intent {
    /// All possible intents of an agent in an event with the given number of objects: 42 with two of them,
    /// its own goals first.
    #[must_use]
    pub fn all(agent: AgentId, objects: usize) -> Vec<Self> {
        let own = physical_goals(agent, objects).into_iter();
        let neutral = own.map(|goal| Self { attitude: Attitude::Neutral, goal });
        let social = [Attitude::Help, Attitude::Hinder].into_iter().flat_map(|attitude| {
            physical_goals(agent.other(), objects).into_iter().map(move |goal| Self { attitude, goal })
        });
        neutral.chain(social).collect()
    }

    /// The hypothesis that an agent has this intent while the other pursues its own goal, which is the
    /// intent's goal if the agent is social and `others` if it is not.
    #[must_use]
    pub fn hypothesis(&self, agent: AgentId, others: Goal, strengths: [Strength; AGENT_COUNT]) -> Hypothesis {
        let mut attitudes = [Attitude::Neutral; AGENT_COUNT];
        attitudes[agent] = self.attitude;
        let mut goals = [self.goal; AGENT_COUNT];
        if self.attitude == Attitude::Neutral {
            goals[agent.other()] = others;
        }
        Hypothesis::new(goals, attitudes, strengths)
    }
}

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
            hypotheses
                .push(weigh(first.hypothesis(AgentId::ZERO, second.goal, strengths), first_log + second_log));
        }
    }
    for (social, intents) in AgentId::ALL.into_iter().zip(weighted_intents) {
        for (intent, log) in intents.iter().filter(|(intent, _)| intent.attitude != Attitude::Neutral) {
            let other = neutral(social.other()).find(|(other, _)| other.goal == intent.goal);
            let Some((_, other_log)) = other else { continue };
            hypotheses.push(weigh(intent.hypothesis(social, intent.goal, strengths), log + other_log));
        }
    }
    hypotheses
}
