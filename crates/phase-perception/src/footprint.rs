//! The cells that a body lies on.

use crate::cells::{Cell, CellSet};
use phase_model::{Body, Entity, PhysicsConfig, Vec2, geometry::Outline};

/// The cells that share inner points with an entity's outline; parts outside the arena have none.
#[must_use]
pub fn footprint(physics: &PhysicsConfig, entity: Entity, body: &Body) -> CellSet {
    let mut cells = CellSet::EMPTY;
    let _ = any_cell(&Outline::of(physics, entity, body), |cell| {
        cells.insert(cell);
        false
    });
    cells
}

/// Whether a condition holds for one of the cells of an outline's footprint. Cells are tried row by row,
/// until one satisfies it.
#[must_use]
pub fn any_cell(outline: &Outline, mut condition: impl FnMut(Cell) -> bool) -> bool {
    let shape = Shape::of(outline);
    near(outline).any(|cell| shape.overlaps(cell) && condition(cell))
}

/// The cells that an outline covers entirely, so that no part of another body can be in them.
#[must_use]
pub fn covered(outline: &Outline) -> CellSet {
    let shape = Shape::of(outline);
    near(outline).filter(|&cell| shape.covers(cell)).collect()
}

/// Half the side of a cell (u).
const HALF: f32 = 0.5;

/// The cells of an outline's bounding box.
fn near(outline: &Outline) -> impl Iterator<Item = Cell> {
    let (min, max) = outline.bounds();
    Cell::in_box(min, max)
}

/// An outline prepared for overlap tests with many cells of equal size.
enum Shape {
    /// The outward normals of the four edges, the extent of the outline along each, and the margins by which
    /// a cell's centre may lie beyond or must lie within it for the cell to be touched or covered.
    Trapezoid([(Vec2, f32, f32); 4]),
    Disc {
        centre: Vec2,
        radius_squared: f32,
    },
}

impl Shape {
    fn of(outline: &Outline) -> Self {
        match *outline {
            Outline::Trapezoid(corners) => Self::Trapezoid(core::array::from_fn(|k| {
                let normal = -(corners[(k + 1) % 4] - corners[k]).perp();
                (normal, normal.dot(corners[k]), HALF * (normal.x.abs() + normal.y.abs()))
            })),
            Outline::Disc { centre, radius } => Self::Disc { centre, radius_squared: radius * radius },
        }
    }

    /// Whether the outline has inner points in a cell of its bounding box. For the trapezoid this is the
    /// separating axis test, whose other two axes are the box's.
    fn overlaps(&self, cell: Cell) -> bool {
        let middle = cell.centre();
        match self {
            Self::Trapezoid(edges) => {
                edges.iter().all(|&(normal, reach, slack)| normal.dot(middle) - slack < reach)
            }
            Self::Disc { centre, radius_squared } => {
                let beyond = ((*centre - middle).abs() - HALF).max(Vec2::ZERO);
                beyond.length_squared() < *radius_squared
            }
        }
    }

    fn covers(&self, cell: Cell) -> bool {
        let middle = cell.centre();
        match self {
            Self::Trapezoid(edges) => {
                edges.iter().all(|&(normal, reach, slack)| normal.dot(middle) + slack <= reach)
            }
            Self::Disc { centre, radius_squared } => {
                ((*centre - middle).abs() + HALF).length_squared() <= *radius_squared
            }
        }
    }
}
