//! Intents: the part of a hypothesis that concerns one agent.

use crate::{Hypothesis, hypothesis::physical_goals};
use phase_model::{AGENT_COUNT, AgentId, Attitude, Goal, Strength};

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
