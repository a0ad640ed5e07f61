//! Habits: which actions are likely before any search, as priors of PUCT.

use crate::{MindParameters, objective::Objective, rollout_policy};
use phase_model::{Action, State};

/// Distance to go below which an agent may rest (u).
const AT_REST: f32 = 1.0;

/// Prior weight of an action: what the heuristic suggests, what was done last, walking forward, and going on
/// while there is a distance to go are likelier.
pub(crate) fn weight(
    action: Action,
    parameters: &MindParameters,
    objective: &Objective<'_>,
    state: &State,
    context: Context,
) -> f64 {
    let mut weight = 1.0;
    if action == context.heuristic {
        weight *= parameters.heuristic_prior;
    }
    if Some(action) == context.last {
        weight *= parameters.momentum_prior;
    }
    let is_lateral = action.push().is_some() && action != Action::Up;
    if is_lateral && rollout_policy::is_free(state, objective.agent()) {
        weight *= parameters.lateral_prior;
    }
    if matches!(action, Action::Stop | Action::NoForce) && context.distance > AT_REST {
        weight *= parameters.rest_prior;
    }
    weight
}

/// What a prior depends on beside the state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Context {
    /// The heuristic's action.
    pub(crate) heuristic: Action,
    /// The action before.
    pub(crate) last: Option<Action>,
    /// Φ (u).
    pub(crate) distance: f32,
}
