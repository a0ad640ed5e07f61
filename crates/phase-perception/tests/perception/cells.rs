//! Cells and sets of them.

use phase_model::{Vec2, arena};
use phase_perception::{
    Cell, CellSet,
    cells::{CELL_COUNT, CELLS_PER_SIDE},
};
use proptest::prelude::*;

#[test]
fn points_lie_in_the_cells_named() {
    let cases = [
        ((6.0, 2.0), Some(0)),
        ((6.99, 2.99), Some(0)),
        ((7.0, 2.0), Some(1)),
        ((25.99, 2.5), Some(19)),
        ((26.0, 2.5), Some(19)),
        ((6.5, 3.0), Some(20)),
        ((26.0, 22.0), Some(399)),
        ((5.99, 2.5), None),
        ((6.5, 22.01), None),
        ((f32::NAN, 5.0), None),
        ((f32::INFINITY, 5.0), None),
    ];
    for ((x, y), expected) in cases {
        assert_eq!(Cell::at(Vec2::new(x, y)).map(Cell::index), expected, "({x}, {y})");
    }
}

#[test]
fn cells_tile_the_arena() {
    assert_eq!(Cell::all().count(), CELL_COUNT);
    for (index, cell) in Cell::all().enumerate() {
        assert_eq!(cell.index(), index);
        assert_eq!(Cell::from_index(index), Some(cell));
        assert_eq!(Cell::at(cell.centre()), Some(cell));
        assert_eq!(Cell::at(cell.min()), Some(cell));
        assert!(arena::contains(cell.min()) && arena::contains(cell.min() + 1.0));
    }
    assert_eq!(Cell::from_index(CELL_COUNT), None);
}

#[test]
fn boxes_have_the_cells_they_share_inner_points_with() {
    let cases = [
        ((6.0, 2.0), (7.0, 3.0), 1),
        ((6.9, 2.9), (7.1, 3.1), 4),
        ((7.0, 3.0), (9.0, 4.0), 2),
        ((0.0, 0.0), (30.0, 30.0), CELL_COUNT),
        ((-9.0, -9.0), (5.0, 1.0), 0),
        ((26.0, 5.0), (40.0, 9.0), 0),
        ((f32::NEG_INFINITY, 2.0), (f32::INFINITY, 3.0), CELLS_PER_SIDE),
        ((f32::INFINITY, 2.0), (f32::INFINITY, 3.0), 0),
        ((f32::NAN, 2.0), (f32::NAN, 3.0), 0),
        ((6.0, 2.0), (f32::NAN, 3.0), 0),
    ];
    for (min, max, expected) in cases {
        assert_eq!(Cell::in_box(min.into(), max.into()).count(), expected, "{min:?} to {max:?}");
    }
}

proptest! {
    #[test]
    fn a_set_holds_what_was_put_in(indices in prop::collection::btree_set(0_usize..CELL_COUNT, 0..30),
                                   others in prop::collection::btree_set(0_usize..CELL_COUNT, 0..30)) {
        let set = |indices: &std::collections::BTreeSet<usize>| -> CellSet {
            indices.iter().filter_map(|&index| Cell::from_index(index)).collect()
        };
        let cells = set(&indices);
        prop_assert_eq!(cells.len(), indices.len());
        prop_assert_eq!(cells.is_empty(), indices.is_empty());
        prop_assert!(cells.iter().map(Cell::index).eq(indices.iter().copied()));
        prop_assert!(Cell::all().all(|cell| cells.contains(cell) == indices.contains(&cell.index())));
        prop_assert_eq!(cells.intersects(&set(&others)), !indices.is_disjoint(&others));
    }
}
