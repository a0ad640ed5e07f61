//! Numerical accuracy: tolerances of rounding, resolutions and bounds of memory. None is meant to shape
//! behaviour; [`NavigationParameters`](crate::NavigationParameters) and
//! [`AssemblyParameters`](crate::AssemblyParameters) do. The grid on which assemblies move is in `lattice`.

/// Tolerance of the ends of a passage (u); more than the rounding of a crossing point.
pub(crate) const PASSAGE_TOLERANCE: f32 = 1e-3;
/// Offset of a point on an axis of the arena, where it sees nothing (u).
pub(crate) const OFF_AXIS: f32 = 1e-3;
/// Difference of two distances from the line of a slot below which a leg runs parallel to it (u).
pub(crate) const PARALLEL: f32 = 1e-6;
/// Passes of coordinate descent over the crossing points of a route through several doors. With three the
/// length is within a few hundredths of the shortest one.
pub(crate) const CROSSING_PASSES: usize = 3;
/// Number of points around an obstacle at which paths bend.
pub(crate) const RING: usize = 16;
/// Distance of these points from the obstacle (u), beyond rounding.
pub(crate) const RING_GAP: f32 = 0.01;
/// Tolerance of the distance between a body and a wall (u); more than the rounding of a leg.
pub(crate) const CLEARANCE_TOLERANCE: f32 = 1e-3;
/// Rotation along a descent below which it is a matter of rounding, in steps of the grid.
pub(crate) const LEAST_TURN: f32 = 0.5;
/// Least width of a bucket of the queue (u).
pub(crate) const LEAST_BUCKET: f32 = 0.05;
/// Highest number of a bucket, so that extreme costs do not take all memory; whatever costs more is in no
/// order.
pub(crate) const LAST_BUCKET: usize = 1 << 16;
/// Number of fields that a navigator keeps.
pub(crate) const FIELDS_KEPT: usize = 64;
/// Number of fields of assemblies that are kept; each takes 150 kB.
pub(crate) const ASSEMBLY_FIELDS_KEPT: usize = 128;
