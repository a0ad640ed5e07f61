//! The interface between the high-level and the low-level planner.

use crate::Literal;
use core::fmt;
use serde::{Deserialize, Serialize};

/// An element h of the paper's subgoal space: a predicate to achieve, or no remaining subgoal.
///
/// The high-level planner chooses subgoals and the low-level search achieves them. `Touch(agent 0, agent 1)`
/// and `not Touch(agent 0, agent 1)` are examples of their text.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Subgoal {
    /// Achieve a predicate or its negation.
    Achieve(Literal),
    /// Nothing to do: stop and stay.
    Stay,
}

impl fmt::Display for Subgoal {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Achieve(literal) => literal.fmt(formatter),
            Self::Stay => formatter.write_str("Stay"),
        }
    }
}
