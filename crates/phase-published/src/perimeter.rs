//! The cells that the outline of a body runs through, as the published simulator has them.

use crate::recorded::{CIRCLE_POINTS, GRAIN};
use core::f32::consts::TAU;
use phase_model::{Body, Entity, PhysicsConfig, Vec2, arena, geometry::Outline};
use phase_perception::{Cell, cells::CELLS_PER_SIDE};

/// The cells of a body's outline.
#[derive(Clone, Debug, Default)]
pub(crate) struct Perimeter {
    /// The cells, some of them more than once.
    pub(crate) cells: Vec<Cell>,
    /// Whether part of it lies beyond the row of cells next to the arena's boundary.
    pub(crate) out_of_range: bool,
}

impl Perimeter {
    /// The perimeter of an entity: of an agent the cells of its corners and those between them, of an object
    /// those under sixteen points of its circle.
    pub(crate) fn of(physics: &PhysicsConfig, entity: Entity, body: &Body) -> Self {
        let mut perimeter = Self::default();
        match Outline::of(physics, entity, body) {
            Outline::Trapezoid(corners) => {
                // Clockwise: the cells of a line depend on its direction.
                let corners = corners.map(grid_place);
                for k in 0..corners.len() {
                    line(corners[(k + 1) % corners.len()], corners[k], |place| perimeter.add(place));
                }
            }
            Outline::Disc { centre, radius } => {
                for k in 0..CIRCLE_POINTS {
                    let (sin, cos) = libm::sincosf(TAU * k as f32 / CIRCLE_POINTS as f32);
                    perimeter.add(grid_place(centre + Vec2::new(cos, sin) * radius));
                }
            }
        }
        perimeter
    }

    /// Adds the cell of a place. The cells next to the arena count as its outermost ones.
    fn add(&mut self, (column, row): (i32, i32)) {
        const LAST: i32 = CELLS_PER_SIDE as i32 - 1;
        self.out_of_range |= !(-1..=LAST + 1).contains(&column) || !(-1..=LAST + 1).contains(&row);
        let index = row.clamp(0, LAST) * (LAST + 1) + column.clamp(0, LAST);
        self.cells.extend(usize::try_from(index).ok().and_then(Cell::from_index));
    }
}

/// Column and row of the cell of a point, which may lie outside the arena.
fn grid_place(point: Vec2) -> (i32, i32) {
    let place = ((point / GRAIN).floor() * GRAIN - arena::MIN + Vec2::splat(0.5 * GRAIN)).floor();
    (place.x as i32, place.y as i32)
}

/// The cells of a straight line between two (Bresenham 1965), both ends included.
fn line((mut x, mut y): (i32, i32), (to_x, to_y): (i32, i32), mut visit: impl FnMut((i32, i32))) {
    // Bodies may be anywhere, but no line need be longer than a few arenas.
    const LONGEST: i32 = 8 * CELLS_PER_SIDE as i32;
    let width = to_x.saturating_sub(x).saturating_abs();
    let height = to_y.saturating_sub(y).saturating_abs();
    visit((x, y));
    if width > LONGEST || height > LONGEST {
        return visit((to_x, to_y));
    }
    let step_x = (to_x - x).signum();
    let step_y = (to_y - y).signum();
    let mut error = width - height;
    while (x, y) != (to_x, to_y) {
        let twice = 2 * error;
        if twice > -height {
            error -= height;
            x += step_x;
        }
        if twice < width {
            error += width;
            y += step_y;
        }
        visit((x, y));
    }
}
