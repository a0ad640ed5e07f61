//! Instructions to players before a round.

use phase_model::{AGENT_COUNT, AgentId, Attitude, Entity, Scene, words::Names};
use serde::Serialize;

/// Instructions to a player before a round: both goals in words, as in the paper (appendix, "Experiment 2").
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Instructions {
    /// The colour of the player's agent.
    pub you: &'static str,
    /// The player's own task, in a sentence.
    pub yours: String,
    /// The other agent's task, in a sentence to the player.
    pub theirs: String,
}

impl Instructions {
    /// The instructions for the player of an agent.
    #[must_use]
    pub fn new(scene: &Scene, agent: AgentId, names: &Names) -> Self {
        let other = agent.other();
        let attitudes = scene.attitudes();
        let goal = |who: AgentId| names.wants(scene.goals()[who], who);
        let whom = names.entity(Entity::Agent(other));
        let yours = match attitudes[agent] {
            Attitude::Neutral => format!("Your goal: {}.", goal(agent)),
            Attitude::Help => format!("Help the {whom} reach its goal: {}.", goal(other)),
            Attitude::Hinder => format!("Keep the {whom} from reaching its goal: {}.", goal(other)),
        };
        let them = format!("The other agent ({})", names.agents[other]);
        let theirs = match attitudes[other] {
            Attitude::Neutral => format!("{them} has this goal: {}.", goal(other)),
            Attitude::Help => format!("{them} is trying to help you reach your goal."),
            Attitude::Hinder => format!("{them} is trying to keep you from reaching your goal."),
        };
        Self { you: names.agents[agent], yours, theirs }
    }
}

/// The instructions of both players.
pub(crate) fn of_both(scene: &Scene) -> [Instructions; AGENT_COUNT] {
    AgentId::ALL.map(|agent| Instructions::new(scene, agent, &Names::PAPER))
}
