//! Sampling in proportion to weights.

use crate::memory::CellMemory;
use phase_model::{Body, Entity, geometry::Outline};
use phase_perception::{Cell, cells::CELL_COUNT, footprint::any_cell};
use rand::{Rng, RngExt};

/// The weight of each cell, ready for drawing cells in proportion.
pub(crate) struct Weights {
    weights: [f32; CELL_COUNT],
    /// Sum of the weights up to and including each cell.
    sums: [f32; CELL_COUNT],
}

impl Weights {
    pub(crate) fn new(memory: &CellMemory, entity: Entity) -> Self {
        let mut weights = [0.0; CELL_COUNT];
        let mut sums = [0.0; CELL_COUNT];
        let mut sum = 0.0;
        for cell in Cell::all() {
            let weight = memory.weight(entity, cell);
            sum += weight;
            weights[cell.index()] = weight;
            sums[cell.index()] = sum;
        }
        Self { weights, sums }
    }

    pub(crate) fn of(&self, cell: Cell) -> f32 {
        self.weights[cell.index()]
    }

    /// Samples a cell in proportion to its weight; `None` if all weights are 0.
    pub(crate) fn draw(&self, rng: &mut impl Rng) -> Option<Cell> {
        let mark = rng.random::<f32>() * self.sums[CELL_COUNT - 1];
        // Rounding may place the sample past the last cell.
        Cell::from_index(self.sums.partition_point(|&sum| sum <= mark))
    }

    /// The minimum weight of the cells an outline lies on, 0 if it lies on none.
    pub(crate) fn min_weight(&self, outline: &Outline) -> f32 {
        let mut min_weight = f32::INFINITY;
        let nothing = any_cell(outline, |cell| {
            min_weight = min_weight.min(self.of(cell));
            min_weight <= 0.0
        });
        if nothing || min_weight == f32::INFINITY { 0.0 } else { min_weight }
    }
}

/// A body, kept with a probability in proportion to its weight.
#[derive(Default)]
pub(crate) struct Reservoir {
    pub(crate) kept: Option<Body>,
    total: f32,
}

impl Reservoir {
    pub(crate) fn offer(&mut self, body: Body, weight: f32, rng: &mut impl Rng) {
        if weight > 0.0 {
            self.total += weight;
            if rng.random::<f32>() * self.total < weight {
                self.kept = Some(body);
            }
        }
    }
}
