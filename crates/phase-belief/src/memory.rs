//! An agent's memory of cells: how long ago it last saw each.

use phase_model::Entity;
use phase_perception::{Cell, CellSet, cells::CELL_COUNT};

/// The τ of [`occupancy_weight`] for agents, which move on their own (steps).
pub const AGENT_DECAY_STEPS: f32 = 20.0;
/// The τ for objects, which move only when moved (steps). Events are up to 100 steps long.
pub const OBJECT_DECAY_STEPS: f32 = 200.0;

/// Prior weight, 0 to 1, that an unobserved body occupies a cell last seen `age` steps ago (`None`: never):
/// 1 − exp(−age/τ), with τ in steps. Exactly 0 for a visible cell, exactly 1 for one never seen.
#[must_use]
pub fn occupancy_weight(age: Option<u32>, decay_steps: f32) -> f32 {
    age.map_or(1.0, |age| -libm::expm1f(-(age as f32) / decay_steps))
}

/// The number of steps since each cell was last seen.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct CellMemory {
    ages: [u32; CELL_COUNT],
}

/// The age of cells that have never been seen.
const NEVER: u32 = u32::MAX;

impl CellMemory {
    /// The memory of an agent that has not seen anything yet.
    #[must_use]
    pub const fn new() -> Self {
        Self { ages: [NEVER; CELL_COUNT] }
    }

    /// Advances by one step and records the cells seen at its end.
    pub fn record_seen(&mut self, seen: &CellSet) {
        for (cell, age) in Cell::all().zip(&mut self.ages) {
            *age = match *age {
                _ if seen.contains(cell) => 0,
                NEVER => NEVER,
                age => (age + 1).min(NEVER - 1),
            };
        }
    }

    /// Steps since a cell was last seen, 0 if it is seen now, `None` if it has never been.
    #[must_use]
    pub fn age(&self, cell: Cell) -> Option<u32> {
        let age = self.ages[cell.index()];
        (age != NEVER).then_some(age)
    }

    /// The weight of an entity having got into a cell unseen; see [`occupancy_weight`].
    #[must_use]
    pub fn weight(&self, entity: Entity, cell: Cell) -> f32 {
        let decay_steps = match entity {
            Entity::Agent(_) => AGENT_DECAY_STEPS,
            Entity::Object(_) => OBJECT_DECAY_STEPS,
        };
        occupancy_weight(self.age(cell), decay_steps)
    }
}

impl Default for CellMemory {
    fn default() -> Self {
        Self::new()
    }
}
