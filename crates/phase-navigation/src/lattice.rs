//! The grid of load positions and orientations on which assemblies move.

use phase_model::{Vec2, arena};

/// Distance between neighbouring positions (u).
pub(crate) const SPACING: f32 = 0.5;
/// Positions along each side of the arena. They lie in the middles of squares, so that none is on a wall and
/// one is in the middle of each door of 2.5 u.
pub(crate) const SIDE: usize = 40;
/// Number of orientations.
pub(crate) const ORIENTATIONS: usize = 16;
/// Angle between neighbouring orientations (rad).
pub(crate) const TURN: f32 = core::f32::consts::TAU / ORIENTATIONS as f32;
/// Number of nodes.
pub(crate) const NODES: usize = SIDE * SIDE * ORIENTATIONS;
/// Number of moves from a node: eight translations, then a turn to the left and one to the right.
pub(crate) const MOVES: usize = 10;

/// Steps of the eight translations, counter-clockwise; the opposite of one is four further.
const STEPS: [(i32, i32); 8] = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)];

/// A position and an orientation, by their numbers.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Node {
    pub(crate) column: usize,
    pub(crate) row: usize,
    pub(crate) orientation: usize,
}

impl Node {
    pub(crate) const fn index(self) -> usize {
        (self.orientation * SIDE + self.row) * SIDE + self.column
    }

    pub(crate) const fn from_index(index: usize) -> Self {
        let plane = index / SIDE;
        let column = index % SIDE;
        Self { column, row: plane % SIDE, orientation: plane / SIDE }
    }

    /// Position of the load (u).
    pub(crate) fn position(self) -> Vec2 {
        arena::MIN + SPACING * (Vec2::new(self.column as f32, self.row as f32) + 0.5)
    }

    /// The node after a move; `None` outside the arena.
    pub(crate) fn after(self, step: usize) -> Option<Self> {
        let Some(&(dx, dy)) = STEPS.get(step) else {
            let by = if step == STEPS.len() { 1 } else { ORIENTATIONS - 1 };
            return Some(Self { orientation: (self.orientation + by) % ORIENTATIONS, ..self });
        };
        let column = self.column.checked_add_signed(dx as isize).filter(|&column| column < SIDE)?;
        let row = self.row.checked_add_signed(dy as isize).filter(|&row| row < SIDE)?;
        Some(Self { column, row, ..self })
    }
}

/// The move back.
pub(crate) const fn opposite(step: usize) -> usize {
    if step < STEPS.len() { (step + 4) % STEPS.len() } else { 2 * STEPS.len() + 1 - step }
}

/// Cost of each move when a turn costs some length for each radian (u, u/rad).
pub(crate) fn move_costs(turning: f32) -> [f32; MOVES] {
    core::array::from_fn(|step| match STEPS.get(step) {
        Some((0, _) | (_, 0)) => SPACING,
        Some(_) => SPACING * core::f32::consts::SQRT_2,
        None => turning * TURN,
    })
}

/// The rotation of a move, in units of [`TURN`].
pub(crate) const fn turns(step: usize) -> f32 {
    match step {
        8 => 1.0,
        9 => -1.0,
        _ => 0.0,
    }
}

/// The eight nodes around a configuration with their weights in trilinear interpolation.
pub(crate) fn around(load: Vec2, angle: f32) -> [(Node, f32); 8] {
    let (column, x) = split((load.x - arena::MIN.x) / SPACING - 0.5);
    let (row, y) = split((load.y - arena::MIN.y) / SPACING - 0.5);
    let turns = angle / TURN;
    let whole = turns.floor();
    let left = turns - whole;
    // The remainder is exact for all angles that occur, and never negative.
    let orientation = whole.rem_euclid(ORIENTATIONS as f32) as usize % ORIENTATIONS;
    core::array::from_fn(|k| {
        let i = k & 1;
        let j = k >> 1 & 1;
        let t = k >> 2;
        let share = |bit: usize, fraction: f32| if bit == 1 { fraction } else { 1.0 - fraction };
        let node = Node { column: column + i, row: row + j, orientation: (orientation + t) % ORIENTATIONS };
        (node, share(i, x) * share(j, y) * share(t, left))
    })
}

/// The number of the position below a coordinate, and the fraction above it; at the boundary the outermost.
fn split(coordinate: f32) -> (usize, f32) {
    let inside = coordinate.clamp(0.0, (SIDE - 1) as f32);
    let below = (inside as usize).min(SIDE - 2);
    (below, inside - below as f32)
}
