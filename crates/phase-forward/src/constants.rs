//! The constants of the solver. They are part of the dynamics: the published recordings were made with them.

/// Duration of one substep (s).
pub(crate) const H: f32 = phase_model::arena::SUBSTEP_SECONDS;
/// Maximum impulse of ground friction in one substep (N s).
pub(crate) const MAX_FRICTION_IMPULSE: f32 = phase_model::physics::GROUND_FRICTION * H;
/// Iterations of the velocity solver.
pub(crate) const VELOCITY_ITERATIONS: usize = 10;
/// Iterations of the velocity solver in a substep without warm starting.
pub(crate) const COLD_ITERATIONS: usize = 20;
/// Iterations of the position solver.
pub(crate) const POSITION_ITERATIONS: usize = 10;
/// Iterations of the position solver after an impact on a wall.
pub(crate) const IMPACT_POSITION_ITERATIONS: usize = 20;
/// The velocity solver stops when no impulse changes by more than this (N s).
pub(crate) const IMPULSE_TOLERANCE: f32 = 1e-3;
/// Overlap that contacts deliberately keep, so that they do not flicker (u).
pub(crate) const LINEAR_SLOP: f32 = 0.005;
/// Tolerated error of a joint's angle (rad).
pub(crate) const ANGULAR_SLOP: f32 = 2.0 / 180.0 * core::f32::consts::PI;
/// Thickness of the skin around polygons and walls (u).
pub(crate) const SKIN: f32 = 0.01;
/// Share of an overlap that one position iteration corrects.
pub(crate) const BAUMGARTE: f32 = 0.2;
/// Share of an overlap that one position iteration corrects after an impact on a wall.
pub(crate) const IMPACT_BAUMGARTE: f32 = 0.75;
/// Maximum correction of one position iteration (u).
pub(crate) const MAX_CORRECTION: f32 = 0.2;
/// Maximum number of impacts on one wall that one substep resolves.
pub(crate) const MAX_IMPACTS: u8 = 8;
/// Minimum distance of a centre of mass from the boundary (u).
pub(crate) const BOUNDARY_MARGIN: f32 = 0.01;
