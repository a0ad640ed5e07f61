//! Q(g | S): the distribution of goals suggested by a time window of motion alone (appendix, "Bottom-up
//! Proposals").

use phase_model::{AgentId, Body, Entity, Goal, MAX_ENTITIES, Sign, State, arena};
use phase_predicates::threshold::ON_OBJECT;
use phase_statistics::log_softmax;

/// Separation at which an avoidance goal counts as satisfied (u).
const SAFE_DISTANCE: f32 = 14.0;

/// γ of the goal proposal's exponent, per unit of distance (1/u).
///
/// The paper has γ = 10 and does not state the unit. Ten per world unit would make every proposal the same:
/// the goal whose distance shrank most. Per side of the arena it is a cue that leaves uncertainty.
pub const GAMMA: f64 = 10.0 / arena::SIDE as f64;

/// ‖s − s_g‖ of the proposal: how far an agent has to go until the goal holds, in straight lines (u). What
/// has to be moved must be reached first; once it is in place no agent need be near. For getting away it is
/// the remainder to a safe distance.
#[must_use]
pub fn distance_left(goal: Goal, agent: AgentId, state: &State) -> f32 {
    let apart = goal.distance(state);
    match goal {
        Goal::Touch { sign: Sign::Negative, .. } => (SAFE_DISTANCE - apart).max(0.0),
        Goal::ObjectOnLandmark { .. } if apart >= ON_OBJECT => {
            apart + state.position(Entity::Agent(agent)).distance(state.position(goal.subject()))
        }
        _ => apart,
    }
}

/// ln Q(g | S) for each of some goals of an agent, from the rows of a time window; not empty. The
/// probabilities sum to 1. The paper prints e^{γ(2‖s^t2 − s_g‖ − ‖s^t1 − s_g‖)}, under which the goal
/// farthest away would be the most likely; the sentence below it states the opposite, which is implemented
/// here.
#[must_use]
pub fn log_proposal(goals: &[Goal], agent: AgentId, rows: &[[Body; MAX_ENTITIES]], gamma: f64) -> Vec<f64> {
    let (Some(first), Some(last)) = (rows.first(), rows.last()) else {
        return vec![-libm::log(goals.len() as f64); goals.len()];
    };
    let before = State::new(*first);
    let after = State::new(*last);
    let left = |goal: &Goal, state: &State| f64::from(distance_left(*goal, agent, state));
    let log = |goal: &Goal| -gamma * (2.0 * left(goal, &after) - left(goal, &before));
    let mut logs: Vec<f64> = goals.iter().map(log).collect();
    log_softmax(&mut logs);
    logs
}
