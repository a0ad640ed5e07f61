//! Equation 1 of the paper: the social reward of a state and an action.

use crate::{Action, Attitude};

/// Cost of pushing in any direction but forward.
pub const SIDEWAYS_COST: f64 = 0.02;

/// C(a) as a value of at most 0: the seven pushes that are not forward cost [`SIDEWAYS_COST`]; all other
/// actions are free.
#[must_use]
pub const fn action_cost(action: Action) -> f64 {
    match action {
        Action::Down
        | Action::Left
        | Action::Right
        | Action::UpLeft
        | Action::UpRight
        | Action::DownLeft
        | Action::DownRight => -SIDEWAYS_COST,
        _ => 0.0,
    }
}

/// Rᵢ = (1 − |α|) R(s, gᵢ) + α R(s, gⱼ) + C(a) (Equation 1), from the reward of the agent's own goal, the
/// reward of the other's goal and the action.
#[must_use]
pub fn social_reward(attitude: Attitude, own: f64, other: f64, action: Action) -> f64 {
    let alpha = f64::from(attitude.alpha());
    (1.0 - alpha.abs()) * own + alpha * other + action_cost(action)
}
