//! The belief that a decision is based on.

use crate::theory::Supposition;
use phase_belief::Contest;
use phase_model::{Action, BodySet, State};

/// The belief state that a decision is based on.
#[derive(Clone, Copy, Debug)]
pub struct BeliefView<'a> {
    /// Possible states of the world, all equally likely; at least one.
    pub particles: &'a [State],
    /// The entities that the agent observes now, itself included.
    pub observed: BodySet,
    /// The agent's own last action, if it has acted: action is a habit.
    pub last_action: Option<Action>,
    /// The supposition of each particle about the other; empty if the agent knows the other's goal.
    pub suppositions: &'a [Supposition],
    /// The agent's memory of a contest for an object.
    pub contest: Contest,
}
