//! The square arena: its position, four rooms, landmarks and start points.

use crate::Vec2;

/// Side of the square arena (u).
pub const SIDE: f32 = 20.0;
/// Length of the arena's diagonal (u), rounded to three places as in the published code: the scale of
/// distances in rewards.
pub const DIAGONAL: f32 = 28.284;
/// Centre of the arena, from which all inner walls radiate (u).
pub const CENTRE: Vec2 = Vec2::new(16.0, 12.0);
/// Lower left corner of the arena (u).
pub const MIN: Vec2 = Vec2::new(6.0, 2.0);
/// Upper right corner of the arena (u).
pub const MAX: Vec2 = Vec2::new(26.0, 22.0);
/// Half the side of the square that marks a landmark (u). Landmarks have no physics.
pub const LANDMARK_HALF_SIDE: f32 = 2.5;

/// Centres of the four landmarks, by id: top left, top right, bottom right, bottom left (u).
pub const LANDMARKS: [Vec2; 4] =
    [Vec2::new(8.5, 19.5), Vec2::new(23.5, 19.5), Vec2::new(23.5, 4.5), Vec2::new(8.5, 4.5)];

/// Duration of one physics substep (s).
pub const SUBSTEP_SECONDS: f32 = 1.0 / 60.0;
/// Substeps in one step of the simulation; each is one frame of video.
pub const SUBSTEPS: usize = 5;
/// Duration of one step of the physics (s): 1/12 s, as far as [`SUBSTEP_SECONDS`] is 1/60 s.
pub const STEP_SECONDS: f64 = SUBSTEPS as f64 * SUBSTEP_SECONDS as f64;
/// Video frames per second, three times slower than the physics.
pub const FRAMES_PER_SECOND: u32 = 20;
/// Duration for which one step is shown (s): 0.25 s of video.
pub const STEP_VIDEO_SECONDS: f64 = SUBSTEPS as f64 / FRAMES_PER_SECOND as f64;

/// Whether a point lies inside the arena, boundary included; false for NaN.
#[must_use]
pub fn contains(point: Vec2) -> bool {
    point.x >= MIN.x && point.x <= MAX.x && point.y >= MIN.y && point.y <= MAX.y
}

/// The four points around each room where bodies may start: `START_POINTS[room]` (u).
pub const START_POINTS: [[Vec2; 4]; 4] = [
    [Vec2::new(8.0, 20.0), Vec2::new(8.0, 14.0), Vec2::new(14.0, 16.0), Vec2::new(14.0, 20.0)],
    [Vec2::new(24.0, 20.0), Vec2::new(24.0, 14.0), Vec2::new(18.0, 16.0), Vec2::new(18.0, 20.0)],
    [Vec2::new(24.0, 10.0), Vec2::new(24.0, 4.0), Vec2::new(18.0, 8.0), Vec2::new(18.0, 4.0)],
    [Vec2::new(8.0, 10.0), Vec2::new(8.0, 4.0), Vec2::new(14.0, 8.0), Vec2::new(14.0, 4.0)],
];
