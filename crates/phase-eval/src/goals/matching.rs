//! When two goals are the same.

use phase_model::Goal;

/// A goal in the one form in which goals are compared: right means equal in kind, entity, landmark and sign.
///
/// Touching is the one goal that can be written in two ways, for it is about both agents alike: that agent 1 touches
/// agent 0 is that agent 0 touches agent 1. Labels name the agent that approaches first, in both agents' goals
/// (approaching is sign +1, getting away −1, and so is hindering one that approaches); who is meant is clear from whose
/// goal it is and from the sign. So the canonical form names the agents in order and keeps the sign, and a
/// method is not marked down for naming them the other way round.
#[must_use]
pub fn canonical(goal: Goal) -> Goal {
    match goal {
        Goal::Touch { agent, other, sign } => {
            Goal::Touch { agent: agent.min(other), other: agent.max(other), sign }
        }
        Goal::AgentOnLandmark { .. } | Goal::ObjectOnLandmark { .. } => goal,
    }
}
