//! The 20 × 20 grid of 1 × 1 u cells used for visibility.

use phase_model::{Vec2, arena};

/// Cells along one side of the arena.
pub const CELLS_PER_SIDE: usize = 20;
/// Cells in the arena.
pub const CELL_COUNT: usize = CELLS_PER_SIDE * CELLS_PER_SIDE;

/// One cell: row 0 is the lowest (y from 2 to 3), column 0 the leftmost (x from 6 to 7).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Cell(u16);

impl Cell {
    /// All cells, row by row from the bottom left.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..CELL_COUNT as u16).map(Self)
    }

    /// The cell a point lies in, or `None` outside the arena.
    #[must_use]
    pub fn at(point: Vec2) -> Option<Self> {
        if !arena::contains(point) {
            return None;
        }
        let offset = point - arena::MIN;
        let clamp = |coordinate: f32| (coordinate as usize).min(CELLS_PER_SIDE - 1);
        Some(Self((clamp(offset.y) * CELLS_PER_SIDE + clamp(offset.x)) as u16))
    }

    /// The cells that have inner points in common with a box (lower left and upper right corner, u); parts
    /// outside the arena are ignored. A box with NaN in it has none.
    pub fn in_box(min: Vec2, max: Vec2) -> impl Iterator<Item = Self> {
        let max = if min.cmple(max).all() { max } else { arena::MIN };
        let low = (min - arena::MIN).floor().max(Vec2::ZERO);
        let high = (max - arena::MIN).ceil().min(Vec2::splat(CELLS_PER_SIDE as f32)).max(low);
        let columns = (low.x as usize)..(high.x as usize);
        let rows = (low.y as usize)..(high.y as usize);
        rows.flat_map(move |row| {
            columns.clone().map(move |column| Self((row * CELLS_PER_SIDE + column) as u16))
        })
    }

    /// Position in row-major order, 0 to 399.
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// The cell at an index as in [`Cell::index`], or `None` past the last.
    #[must_use]
    pub fn from_index(index: usize) -> Option<Self> {
        (index < CELL_COUNT).then_some(Self(index as u16))
    }

    /// Lower left corner (u).
    #[must_use]
    pub fn min(self) -> Vec2 {
        let row = self.index() / CELLS_PER_SIDE;
        let column = self.index() % CELLS_PER_SIDE;
        arena::MIN + Vec2::new(column as f32, row as f32)
    }

    /// Centre (u).
    #[must_use]
    pub fn centre(self) -> Vec2 {
        self.min() + Vec2::splat(0.5)
    }
}

/// A set of cells, one bit each.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct CellSet([u64; 7]);

impl CellSet {
    /// The empty set.
    pub const EMPTY: Self = Self([0; 7]);

    /// Adds a cell.
    pub fn insert(&mut self, cell: Cell) {
        self.0[cell.index() / 64] |= 1 << (cell.index() % 64);
    }

    /// Whether a cell is in the set.
    #[must_use]
    pub fn contains(&self, cell: Cell) -> bool {
        self.0[cell.index() / 64] & (1 << (cell.index() % 64)) != 0
    }

    /// Number of cells in the set.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// Whether the set is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0 == [0; 7]
    }

    /// The cells in either set.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self(core::array::from_fn(|k| self.0[k] | other.0[k]))
    }

    /// Whether the two sets have a cell in common.
    #[must_use]
    pub fn intersects(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).any(|(a, b)| a & b != 0)
    }

    /// The cells in the set, in index order.
    pub fn iter(&self) -> impl Iterator<Item = Cell> {
        Cell::all().filter(|&cell| self.contains(cell))
    }
}

impl FromIterator<Cell> for CellSet {
    fn from_iter<I: IntoIterator<Item = Cell>>(cells: I) -> Self {
        let mut set = Self::EMPTY;
        cells.into_iter().for_each(|cell| set.insert(cell));
        set
    }
}
