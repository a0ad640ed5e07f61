//! Equality of goals.

use phase_model::Goal;

/// The canonical form in which goals are compared: correct means equal in kind, entity, landmark and sign.
///
/// Touching is the only goal that can be written in two ways, since it is about both agents alike: agent 1
/// touches agent 0 if and only if agent 0 touches agent 1. Labels name the agent that approaches first, in
/// both agents' goals (approaching has sign +1, getting away −1, as has hindering an agent that approaches);
/// the owner of the goal and its sign determine the roles. So the canonical form names the agents in order
/// and keeps the sign, and a method is not penalised for naming them in the other order.
#[must_use]
pub fn canonical(goal: Goal) -> Goal {
    match goal {
        Goal::Touch { agent, other, sign } => {
            Goal::Touch { agent: agent.min(other), other: agent.max(other), sign }
        }
        Goal::AgentOnLandmark { .. } | Goal::ObjectOnLandmark { .. } => goal,
    }
}
