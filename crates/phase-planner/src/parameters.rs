//! The numbers that shape plans; those of numerical accuracy are in `accuracy`.

use phase_model::setting::{RangeError, Setting};
use phase_navigation::IMPASSABLE_COST;
use serde::{Deserialize, Serialize};

/// The numbers that shape the plans of a [`Planner`](crate::Planner), besides λ, which compares plans
/// ([`value::candidates`](crate::value::candidates)).
///
/// ```
/// use phase_planner::PlannerParameters;
///
/// let lazy = PlannerParameters { effort: 1.0, ..PlannerParameters::default() };
/// assert_eq!(lazy.impassable, 100.0);
/// ```
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct PlannerParameters {
    /// Cost of grasping or releasing an object (u); at least 0.
    pub grasp: f32,
    /// Price of a door that is too narrow and of a load that its holders are too weak to move (u), and the
    /// cost from which a plan counts as infeasible. More than any feasible plan costs, yet finite, so that an
    /// agent without a better plan still tries. By default [`IMPASSABLE_COST`], 100 u.
    pub impassable: f32,
    /// Effort weight: cost of 1 u of travel for or against the other's goal, relative to 1 u that it spares
    /// or costs the other; 0 to 1.
    pub effort: f32,
    /// Clearance beside the other's path (u) within which an agent without a part in the other's plan gives
    /// way; at least 0.
    pub yielding_clearance: f32,
    /// Distance behind a door at which an object lies that was passed through it (u); at least 0.
    pub passing_depth: f32,
}

impl PlannerParameters {
    /// Every number with its name, unit and range, in the order of the fields. Lengths end at five times the
    /// side of the arena.
    #[must_use]
    pub fn settings(&self) -> [(Setting, f64); 5] {
        let length = |name| Setting::real(name, "u", 0.0, 100.0);
        [
            (Setting::real("grasp", "u", 0.0, 1000.0), self.grasp.into()),
            (Setting::real("impassable", "u", 0.0, 1e6), self.impassable.into()),
            (Setting::real("effort", "", 0.0, 1.0), self.effort.into()),
            (length("yielding_clearance"), self.yielding_clearance.into()),
            (length("passing_depth"), self.passing_depth.into()),
        ]
    }

    /// Checks that every number is in its range.
    ///
    /// ```
    /// use phase_planner::PlannerParameters;
    ///
    /// let odd = PlannerParameters { effort: f32::NAN, ..PlannerParameters::default() };
    /// assert_eq!(odd.validate().unwrap_err().to_string(), "field `effort` must be 0 to 1, not NaN");
    /// ```
    ///
    /// # Errors
    /// [`RangeError`], which names the first that is not.
    pub fn validate(&self) -> Result<(), RangeError> {
        self.settings().iter().try_for_each(|(setting, value)| setting.check(*value))
    }
}

impl Default for PlannerParameters {
    fn default() -> Self {
        Self {
            grasp: 1.0,
            impassable: IMPASSABLE_COST,
            effort: 0.4,
            yielding_clearance: 0.4,
            passing_depth: 1.2,
        }
    }
}
