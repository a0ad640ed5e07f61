//! The numbers of the published program that cannot be chosen, and where its code has them. `G` is
//! `gaze_two_agents.py`, `A` is `MCTS_particle_2agents.py`, `M` is `MCTS_particles.py`.

/// Width of the arena from corner to corner, the greatest distance there is (u) (G, `get_reward_state`).
pub(crate) const DIAGONAL: f64 = 20.0 * core::f64::consts::SQRT_2;
/// Worth of an object in the right room, as a distance (u) (G, `get_reward_state`).
pub(crate) const ROOM_BONUS: f64 = 10.0 * DIAGONAL;
/// Distance along each axis of a room's corner point from the arena's centre (u) (G, `_get_dist_room`).
pub(crate) const ROOM_CORNER: f32 = 8.75;
/// An agent is on a landmark within this distance (u): a reward above −0.02 (A, `goal_decomposition`).
pub(crate) const AGENT_REACHED: f64 = 0.02 * DIAGONAL;
/// An object is on a landmark within this distance (u): a reward above −0.05 (A, `goal_decomposition`).
pub(crate) const OBJECT_REACHED: f64 = 0.05 * DIAGONAL;
/// An agent that is closer to what it wants to touch needs no help (u): a reward above −0.1 (A,
/// `goal_decomposition_friendly`).
pub(crate) const TOUCH_REACHED: f64 = 0.1 * DIAGONAL;
/// Width of an agent that carries, for doors: one and a half times its size on each side (A, `plan_*`).
pub(crate) const CARRYING_WIDTH: f32 = 1.5;
/// The layout in which a hinderer carries a small object to the first room if the other is small, too (A,
/// `put_hinder`).
pub(crate) const SMALL_PLUG_BASE: u8 = 4;

/// Seed of the random numbers of a step's searches (M, `MCTS.__init__`).
pub(crate) const SEARCH_SEED: u32 = 1;

/// Factor by which outlines are enlarged to tell whether bodies touch (G, `calculate_collision`).
pub(crate) const TOUCH_SCALE: f32 = 1.2;
/// The place at which a ray crosses a wall is rounded to this (u) (G, `_update_FOV`).
pub(crate) const SIGHT_GRAIN: f32 = 0.01;
/// Points on an object's circle whose cells are its perimeter (G, `update_observations`).
pub(crate) const CIRCLE_POINTS: usize = 16;
/// Points are rounded down to multiples of this before their cells are looked up (u) (G, `_update_FOV`).
pub(crate) const GRAIN: f32 = 0.1;

/// Half the number of integer places along one side over which unseen bodies are spread at first (A,
/// `Belief`).
pub(crate) const INITIAL_REACH: i32 = 8;
/// Factor by which observed bodies are enlarged: unseen ones keep that clear of them (A,
/// `resample_inconsistent_entity`, as the next four).
pub(crate) const CLEARANCE_SCALE: f32 = 1.1;
/// Distance along each axis within which an unseen body counts as where it truly is (u).
pub(crate) const NEAR_TRUTH: f32 = 1.0;
/// Cells tried for a body that keeps clear of others, and again for one that need not.
pub(crate) const CELL_DRAWS: usize = 10;
/// Headings tried at each cell.
pub(crate) const HEADINGS: usize = 8;
