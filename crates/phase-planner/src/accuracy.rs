//! Numerical accuracy: resolutions and tolerances. None is meant to shape behaviour;
//! [`PlannerParameters`](crate::PlannerParameters) does.

/// Units of A*'s costs in one world unit (1/u): A* needs a totally ordered cost.
pub(crate) const COST_RESOLUTION: f32 = 256.0;
/// Highest cost that A* distinguishes (u); NaN counts as 0.
pub(crate) const HIGHEST_COST: f32 = 1e6;
/// Highest lower bound on what is left, in units of A*'s costs: more than any plan costs, and little enough
/// to be added to.
pub(crate) const HIGHEST_BOUND: u64 = 1 << 62;
/// Length of a route relative to the straight line up to which it counts as straight: rounding of its
/// crossings.
pub(crate) const STRAIGHT: f32 = 1.01;
