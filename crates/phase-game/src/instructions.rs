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
    /// The other agent's task, in a sentence.
    pub theirs: String,
}

impl Instructions {
    /// The instructions for the player of an agent.
    #[must_use]
    pub fn new(scene: &Scene, agent: AgentId, names: &Names) -> Self {
        let other = agent.other();
        let told = |who: AgentId, whose: &str| {
            let goals = scene.goals();
            let whom = names.entity(Entity::Agent(who.other()));
            let helped = names.wants(goals[who.other()], who.other());
            match scene.attitudes()[who] {
                Attitude::Neutral => format!("{whose} goal: {}.", names.wants(goals[who], who)),
                Attitude::Help => {
                    format!("Help the {} to reach its goal: {helped}.", whom)
                }
                Attitude::Hinder => {
                    format!("Keep the {} from reaching its goal: {helped}.", whom)
                }
            }
        };
        Self { you: names.agents[agent], yours: told(agent, "Your"), theirs: told(other, "Its") }
    }
}

/// The instructions of both players.
pub(crate) fn of_both(scene: &Scene) -> [Instructions; AGENT_COUNT] {
    AgentId::ALL.map(|agent| Instructions::new(scene, agent, &Names::PAPER))
}
