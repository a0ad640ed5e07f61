//! The numbers that shape plans.

use phase_navigation::IMPASSABLE_COST;
use serde::{Deserialize, Serialize};

/// Costs of the high level, all in world units of travel (u) or relative to them.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct PlannerCosts {
    /// Cost of grasping or releasing an object (u); at least 0.
    pub grasp: f32,
    /// Price of a door that is too narrow and of a load that its holders are too weak to move (u), and the cost
    /// from which a plan counts as infeasible. More than any feasible plan costs, yet finite, so that an agent
    /// without a better plan still tries. By default [`IMPASSABLE_COST`], 100 u.
    pub impassable: f32,
    /// Effort weight: what 1 u of travel for or against the other's goal costs, relative to 1 u that it spares
    /// or costs the other; 0 to 1.
    pub effort: f32,
}

impl Default for PlannerCosts {
    fn default() -> Self {
        Self { grasp: 1.0, impassable: IMPASSABLE_COST, effort: 0.4 }
    }
}
