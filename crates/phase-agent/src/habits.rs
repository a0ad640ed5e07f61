//! Habits: which actions are likely before any search, as priors of PUCT.

use crate::{objective::Objective, rollout_policy};
use phase_model::{Action, Entity, State};

/// Prior weight of an action: what the heuristic suggests, going on as before, walking forward, and not
/// resting while there is a distance to go are likelier.
///
/// An agent that touches or holds another body does not walk: every direction is as likely, and what did not
/// move it is not repeated out of habit.
pub(crate) fn weight(action: Action, objective: &Objective<'_>, state: &State, context: Context) -> f64 {
    let mut weight = 1.0;
    let agent = objective.agent();
    let parameters = objective.parameters();
    let walks = walks(objective, state);
    if action == context.heuristic {
        weight *= parameters.heuristic_prior;
    }
    let is_moving = state.body(Entity::Agent(agent)).velocity.length() > parameters.moving_speed;
    if Some(action) == context.last && (is_moving || walks) {
        weight *= parameters.momentum_prior;
    }
    let is_lateral = action.push().is_some() && action != Action::Up;
    if is_lateral && walks {
        weight *= parameters.lateral_prior;
    }
    if matches!(action, Action::Stop | Action::NoForce) && context.distance > parameters.rest_distance {
        weight *= parameters.rest_prior;
    }
    weight
}

/// Whether an agent moves freely: with free hands, and touching nothing.
fn walks(objective: &Objective<'_>, state: &State) -> bool {
    let me = Entity::Agent(objective.agent());
    rollout_policy::is_free(state, objective.agent())
        && !objective.physics().entities().any(|entity| state.contacts.touching(me, entity))
}

/// The circumstances that a prior depends on beside the state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Context {
    /// The heuristic's action.
    pub(crate) heuristic: Action,
    /// The action before.
    pub(crate) last: Option<Action>,
    /// Φ (u).
    pub(crate) distance: f32,
}
