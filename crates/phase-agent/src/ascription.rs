//! The policy that a mind ascribes to another agent, and the numbers of its theory of mind.

use crate::{
    action_set,
    habits::{self, Context},
    objective::Objective,
    rollout_policy,
};
use phase_model::{Action, State};

/// Number of actions.
pub(crate) const ACTIONS: usize = Action::ALL.len();

/// The numbers of a theory of mind.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct TheoryParameters {
    /// Exponent of the policy that the other is supposed to have, 0 or more: how surely it does what its
    /// intent suggests.
    pub sharpness: f64,
    /// Probability that the other acts regardless of its intent, 0 to 1.
    pub lapse: f64,
    /// Exponent of the likelihood of each step, 0 to 1: steps are not independent.
    pub inverse_temperature: f64,
    /// Share of the prior that every step mixes in while the other is seen, 0 to 1, so that no intent is
    /// ruled out for ever.
    pub forgetting: f64,
    /// Share of the prior that a step mixes in while the other is not seen, 0 to 1.
    pub fading: f64,
    /// Scale of the difference between predicted and seen positions of a body after a step (u).
    pub position_scale: f32,
    /// Scale of the difference between predicted and seen velocities (u/s).
    pub velocity_scale: f32,
    /// Scale of the difference between predicted and seen angles (rad).
    pub angle_scale: f32,
    /// Share of the particles whose intents have to agree on a subgoal before a helper or hinderer pursues
    /// it, 0 to 1.
    pub confidence: f64,
    /// Steps of watching after which a helper or hinderer acts, whatever the share (above 0).
    pub patience: f64,
    /// Cost of a step for a hinderer of level 2 that the other is sure to be hindered by (reward), at least
    /// 0; in proportion to how sure the other is.
    pub discretion: f64,
    /// Bearing of the other, relative to its own heading, up to which a watcher does not turn (rad).
    pub watching_angle: f32,
}

impl Default for TheoryParameters {
    fn default() -> Self {
        Self {
            sharpness: 2.0,
            lapse: 0.1,
            inverse_temperature: 0.5,
            forgetting: 0.005,
            fading: 0.01,
            position_scale: 0.05,
            velocity_scale: 0.25,
            angle_scale: 0.05,
            confidence: 0.6,
            patience: 24.0,
            discretion: 1.0,
            watching_angle: 0.5,
        }
    }
}

/// The policy that a mind ascribes to another agent.
///
/// [`HabitPolicy`] is the heuristic one; a learnt one implements this trait.
pub trait AscribedPolicy {
    /// Weights of the actions of [`Action::ALL`]: how likely each is for an agent that pursues a subgoal in a
    /// state, up to a common factor. `last` is its action before, if that is known.
    fn weights(&self, objective: &Objective<'_>, state: &State, last: Option<Action>) -> [f64; ACTIONS];
}

/// The habits of PHASE minds: what the heuristic suggests, going on as before, walking forward, and not
/// resting while there is a distance to go are likelier.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HabitPolicy {
    /// Exponent of the weights.
    pub sharpness: f64,
}

impl AscribedPolicy for HabitPolicy {
    fn weights(&self, objective: &Objective<'_>, state: &State, last: Option<Action>) -> [f64; ACTIONS] {
        let context = Context {
            heuristic: rollout_policy::action(objective, state),
            last,
            distance: objective.distance(state),
        };
        let mut weights = [0.0; ACTIONS];
        for &action in action_set::actions(objective.agent(), objective.subgoal()) {
            let weight = habits::weight(action, objective, state, context);
            weights[action.index()] = libm::pow(weight, self.sharpness);
        }
        weights
    }
}

/// Makes weights sum up to 1 and mixes in a share of their prior.
pub(crate) fn normalise(weights: &mut [f64], prior: impl Iterator<Item = f64>, forgetting: f64) {
    let sum: f64 = weights.iter().sum();
    for (weight, prior) in weights.iter_mut().zip(prior) {
        let share = if sum > 0.0 { *weight / sum } else { prior };
        *weight = (1.0 - forgetting) * share + forgetting * prior;
    }
}
