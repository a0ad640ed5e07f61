//! The field of view: drawn cases, and agreement with the slow reckoning.

use crate::{
    common::{AWAY, BALL, BOX, ME, OTHER, any_physique, any_state, looking, physique, wall, with},
    oracle::look,
};
use core::f32::consts::{FRAC_PI_2, PI};
use phase_model::{Body, Size, State, Vec2};
use phase_perception::{Cell, CellSet, field_of_view, footprint, sees};
use proptest::prelude::*;

/// The arena from above: `o` for visible cells.
fn drawn(cells: &CellSet) -> Vec<String> {
    let row = |row: usize| {
        (0..20)
            .map(|column| match Cell::from_index(row * 20 + column) {
                Some(cell) if cells.contains(cell) => 'o',
                _ => '.',
            })
            .collect()
    };
    (0..20).rev().map(row).collect()
}

fn check(walls: &[((f32, f32), (f32, f32))], state: &State, expected: [&str; 20]) {
    let physique = physique(walls.iter().map(|&(a, b)| wall(a, b)).collect(), Size::Small);
    let seen = drawn(&field_of_view(&physique, state, 0));
    assert_eq!(seen, expected, "seen:\n{}\n", seen.join("\n"));
}

#[test]
fn an_empty_room_is_seen_as_far_as_the_cone_reaches() {
    check(&[], &looking((16.5, 6.5), 0.0), [""; 20]);
}
#[test]
fn a_wall_and_its_door() {
    check(&[((16.0, 12.0), (6.0, 12.0)), ((18.5, 12.0), (26.0, 12.0))], &looking((14.5, 6.5), 0.0), [""; 20]);
}
#[test]
fn body() {
    check(&[], &with(with(looking((8.5, 12.0), -FRAC_PI_2), BALL, (13.0, 12.0)), OTHER, (20.0, 17.0)), [""; 20]);
}
