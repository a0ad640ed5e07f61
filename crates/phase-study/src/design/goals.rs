//! Goals in the words of the form.

use phase_model::{AgentId, Attitude, Goal, Sign, words::Names};
use std::collections::BTreeSet;

/// The answers about the goals of both agents that are right. An agent who helps or hinders may be said to,
/// or to have the goal that follows. `None` where the form has no words for a goal: to stay off a landmark.
#[must_use]
pub fn known_goals(goals: [Goal; 2], attitudes: [Attitude; 2]) -> Option<[BTreeSet<String>; 2]> {
    let of = |agent: AgentId| {
        let goal = goals[agent.index()];
        let attitude = attitudes[agent.index()];
        let mut words: BTreeSet<String> = physical(goal, agent).into_iter().collect();
        match attitude {
            Attitude::Help => words.insert("help".into()),
            Attitude::Hinder => words.insert("hinder".into()),
            Attitude::Neutral => false,
        };
        (!words.is_empty()).then_some(words)
    };
    Some([of(AgentId::ZERO)?, of(AgentId::ONE)?])
}

/// A goal about the agent's own place, an object or the other agent.
fn physical(goal: Goal, whose: AgentId) -> Option<String> {
    let Names { objects, landmarks, .. } = Names::PAPER;
    match goal {
        Goal::AgentOnLandmark { agent, landmark, sign: Sign::Positive } if agent == whose => {
            Some(format!("agent on {}", landmarks[landmark.index()]))
        }
        Goal::ObjectOnLandmark { object, landmark, sign: Sign::Positive } => {
            Some(format!("{} on {}", objects[object.index()], landmarks[landmark.index()]))
        }
        Goal::Touch { sign: Sign::Positive, .. } => Some("touch".into()),
        Goal::Touch { sign: Sign::Negative, .. } => Some("get away".into()),
        Goal::AgentOnLandmark { .. } | Goal::ObjectOnLandmark { .. } => None,
    }
}
