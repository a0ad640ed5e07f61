//! Floors with arbitrary walls, compared with a search on a fine grid.

use phase_model::{Segment, Vec2};
use phase_navigation::{Area, Floor, FloorError, FloorField, Mover};
use proptest::prelude::*;
use std::{cmp::Reverse, collections::BinaryHeap};

const WIDTH: f32 = 12.0;
const HEIGHT: f32 = 8.0;
/// Distance between neighbouring points of the grid (u).
const STEP: f32 = 0.1;

/// Shortest paths on a grid whose points are at least `clearance` from all walls, with moves to 16
/// neighbours: length from each point to the target, at most 2.8 % more than the shortest.
fn grid(walls: &[Segment], clearance: f32, target: Vec2) -> impl Fn(Vec2) -> f32 {
    let columns = (WIDTH / STEP) as i32 + 1;
    let rows = (HEIGHT / STEP) as i32 + 1;
    let place = |column: i32, row: i32| Vec2::new(column as f32, row as f32) * STEP;
    let is_free = |point: Vec2| {
        let sides = point.min(Vec2::new(WIDTH, HEIGHT) - point).min_element();
        sides >= clearance && walls.iter().all(|wall| wall.distance(point) >= clearance)
    };
    let index = move |point: Vec2| {
        let cell = (point / STEP).round();
        (cell.y as i32 * columns + cell.x as i32) as usize
    };
    let mut lengths = vec![f32::INFINITY; (columns * rows) as usize];
    let mut open = BinaryHeap::new();
    lengths[index(target)] = 0.0;
    open.push(Reverse((0, index(target) as i32)));
    let moves: Vec<(i32, i32)> = (-2..=2)
        .flat_map(|dx| (-2..=2).map(move |dy| (dx, dy)))
        .filter(|&(dx, dy): &(i32, i32)| dx.abs().max(dy.abs()) == 1 || dx.abs() + dy.abs() == 3)
        .collect();
    while let Some(Reverse((cost, k))) = open.pop() {
        let (column, row) = (k % columns, k / columns);
        if cost as f32 / 1e4 > lengths[k as usize] + 1e-3 {
            continue;
        }
        for &(dx, dy) in &moves {
            let (to_column, to_row) = (column + dx, row + dy);
            if !(0..columns).contains(&to_column) || !(0..rows).contains(&to_row) {
                continue;
            }
            let (here, there) = (place(column, row), place(to_column, to_row));
            let leg = Segment { a: here, b: there };
            if !is_free(there) || !is_free(leg.middle()) || walls.iter().any(|wall| wall.crosses(leg)) {
                continue;
            }
            let length = lengths[k as usize] + leg.length();
            let next = (to_row * columns + to_column) as usize;
            if length < lengths[next] - 1e-4 {
                lengths[next] = length;
                open.push(Reverse(((length * 1e4) as i64, next as i32)));
            }
        }
    }
    move |from| lengths[index(from)]
}

fn points() -> impl Strategy<Value = Vec2> {
    (0_u8..=120, 0_u8..=80).prop_map(|(x, y)| Vec2::new(f32::from(x), f32::from(y)) * STEP)
}

fn walls() -> impl Strategy<Value = Vec<Segment>> {
    proptest::collection::vec((points(), points()).prop_map(|(a, b)| Segment { a, b }), 0..7)
}

fn floor(walls: Vec<Segment>) -> Floor {
    Floor::new(Vec2::ZERO, Vec2::new(WIDTH, HEIGHT), walls).expect("a floor")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn distances_are_those_of_a_grid(
        walls in walls(), from in points(), to in points(), half_width in STEP..1.0,
    ) {
        let clearance = |point: Vec2| {
            let sides = point.min(Vec2::new(WIDTH, HEIGHT) - point).min_element();
            walls.iter().map(|wall| wall.distance(point)).fold(sides, f32::min)
        };
        // Both are in the open, or the body is narrower.
        let half_width = half_width.min(clearance(from) - 1.1 * STEP).min(clearance(to) - 1.1 * STEP);
        // Where the mover fits, a body narrower by a step of the grid fits on its points.
        prop_assume!(half_width >= STEP);
        // A body that is a little narrower or wider than the mover.
        let narrow = grid(&walls, half_width - STEP, to)(from);
        let wide = grid(&walls, half_width + STEP, to)(from);
        let field = FloorField::new(&floor(walls), to, Mover { half_width });
        match field.distance(from) {
            Some(distance) => {
                prop_assert!(narrow.is_finite(), "{distance}, but the grid has no way");
                prop_assert!(distance >= narrow / 1.03 - 2.0 * STEP, "{distance}, on the grid {narrow}");
                prop_assert!(distance <= 1.02 * wide + STEP, "{distance}, on the grid {wide}");
            }
            None => prop_assert!(wide.is_infinite(), "no way, on the grid {wide}"),
        }
    }

    /// A path is as long as its distance, and keeps from all walls.
    #[test]
    fn paths_keep_from_walls(
        walls in walls(), from in points(), to in points(), half_width in 0.0_f32..1.0,
    ) {
        let field = FloorField::new(&floor(walls.clone()), to, Mover { half_width });
        let Some(path) = field.path(from) else {
            prop_assert_eq!(field.distance(from), None);
            return Ok(());
        };
        let path: Vec<Vec2> = core::iter::once(from).chain(path).collect();
        let length: f32 = path.windows(2).map(|leg| leg[0].distance(leg[1])).sum();
        prop_assert!((length - field.distance(from).expect("a path has a length")).abs() < 1e-3);
        prop_assert_eq!(path.last(), Some(&to));
        for leg in path.windows(2) {
            for k in 0..=100 {
                let point = leg[0].lerp(leg[1], k as f32 / 100.0);
                for wall in &walls {
                    let needed = half_width.min(wall.distance(leg[0]));
                    prop_assert!(wall.distance(point) >= needed - 2e-3);
                }
            }
        }
    }
}

/// A door takes a body of its own width, and none that is wider.
#[test]
fn doors_take_what_fits() {
    let door = 3.0;
    let wall = |from, to| Segment { a: Vec2::new(6.0, from), b: Vec2::new(6.0, to) };
    let floor = floor(vec![wall(0.0, 2.0), wall(2.0 + door, HEIGHT)]);
    let distance =
        |half_width, from| FloorField::new(&floor, Vec2::new(9.0, 3.5), Mover { half_width }).distance(from);
    let [ahead, aside] = [Vec2::new(3.0, 3.5), Vec2::new(2.0, 1.6)];
    for half_width in [0.0, 0.5, 1.4, 1.45, 1.47, 1.49, 1.5] {
        let straight = distance(half_width, ahead).expect("it fits");
        assert!((straight - 6.0).abs() < 1e-3, "{half_width}: {straight}");
        let bent = distance(half_width, aside).expect("it fits from the side, too");
        assert!((0.0..0.5).contains(&(bent - aside.distance(Vec2::new(9.0, 3.5)))), "{half_width}: {bent}");
    }
    assert_eq!([ahead, aside].map(|from| distance(1.51, from)), [None; 2]);
}

/// A body may leave a wall that it is too near to, and has no way to where it would be too near.
#[test]
fn a_body_leaves_walls_and_goes_to_none() {
    let floor = floor(vec![Segment { a: Vec2::new(6.0, 0.0), b: Vec2::new(6.0, 6.0) }]);
    let [near, far] = [Vec2::new(5.7, 3.0), Vec2::new(3.0, 3.0)];
    let distance = |from, to, half_width| FloorField::new(&floor, to, Mover { half_width }).distance(from);
    assert_eq!(distance(near, far, 0.5), Some(near.distance(far)));
    assert_eq!(distance(far, near, 0.5), None);
    assert_eq!(distance(far, near, 0.2), Some(near.distance(far)));
    // On the wall itself nothing is free.
    assert_eq!(distance(Vec2::new(6.0, 3.0), far, 0.5), None);
}

/// Rooms behind each other: the nearest point of a room is the end, whichever way is shorter.
#[test]
fn rooms_are_reached_at_their_nearest_point() {
    let wall = Segment { a: Vec2::new(6.0, 0.0), b: Vec2::new(6.0, 6.0) };
    let floor = floor(vec![wall]);
    let room = Area { min: Vec2::new(6.5, 0.0), max: Vec2::new(WIDTH, HEIGHT) };
    let field = FloorField::new(&floor, room, Mover { half_width: 0.0 });
    // Up to the wall's end, and half a unit further.
    let distance = field.distance(Vec2::new(3.0, 2.0)).expect("a way");
    assert!((distance - 5.5).abs() < 0.03, "{distance}");
    assert_eq!(field.distance(Vec2::new(7.0, 2.0)), Some(0.0));
    let ahead = field.waypoint(Vec2::new(3.0, 2.0), 5.0).expect("a way");
    assert!((ahead - Vec2::new(6.0, 6.0)).length() < 0.05, "{ahead}");
}

#[test]
fn what_is_no_floor_is_refused() {
    let size = |min, max| Floor::new(min, max, Vec::new()).map(drop);
    for (min, max) in [(Vec2::ZERO, Vec2::ZERO), (Vec2::ONE, Vec2::ZERO), (Vec2::NAN, Vec2::ONE)] {
        assert!(matches!(size(min, max), Err(FloorError::Size { .. })));
    }
    let wall = |a, b| Floor::new(Vec2::ZERO, Vec2::ONE, vec![Segment { a, b }]).map(drop);
    for end in [Vec2::splat(1.5), Vec2::NAN, Vec2::INFINITY] {
        assert!(matches!(wall(Vec2::ZERO, end), Err(FloorError::Wall { index: 0, .. })));
        assert!(matches!(wall(end, Vec2::ZERO), Err(FloorError::Wall { index: 0, .. })));
    }
}

/// Nowhere does a query panic, and outside the floor there is no way.
#[test]
fn strange_points_and_bodies_have_no_way() {
    let floor = floor(vec![Segment { a: Vec2::ONE, b: Vec2::ONE }]);
    let strange = [Vec2::NAN, Vec2::INFINITY, Vec2::splat(-1.0), Vec2::splat(1e30)];
    for half_width in [f32::NAN, f32::INFINITY, -1.0, 0.5, 100.0] {
        for target in strange.into_iter().chain([Vec2::splat(4.0)]) {
            let field = FloorField::new(&floor, target, Mover { half_width });
            for from in strange {
                assert_eq!(field.distance(from), None);
                assert!(field.path(from).is_none() && field.waypoint(from, 1.0).is_none());
            }
        }
    }
}
