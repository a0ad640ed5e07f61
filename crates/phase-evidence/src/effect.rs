//! The effect of an agent: an event compared with the same event in which that agent did nothing.

use crate::GoalOutcome;
use serde::{Deserialize, Serialize};

/// The outcome of one goal with and without an agent's contribution.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Effect {
    /// With the agent.
    pub with: GoalOutcome,
    /// Without the agent.
    pub without: GoalOutcome,
}

/// Minimum difference in percent for a time to count as shorter or longer; smaller differences are chance.
const MARGIN_PERCENT: usize = 10;

impl Effect {
    /// Whether the goal was reached only thanks to the agent, or at least a tenth sooner.
    #[must_use]
    pub const fn helped(&self) -> bool {
        better(self.with, self.without)
    }

    /// Whether the goal was missed because of the agent, or reached at least a tenth later.
    #[must_use]
    pub const fn hindered(&self) -> bool {
        better(self.without, self.with)
    }
}

/// Whether one outcome is clearly better than another: reached where the other is not, or clearly sooner.
const fn better(one: GoalOutcome, other: GoalOutcome) -> bool {
    match (one, other) {
        (GoalOutcome { reached: true, .. }, GoalOutcome { reached: false, .. }) => true,
        (
            GoalOutcome { reached: true, steps: Some(one) },
            GoalOutcome { reached: true, steps: Some(other) },
        ) => one < other && 100 * one <= (100 - MARGIN_PERCENT) * other,
        _ => false,
    }
}
