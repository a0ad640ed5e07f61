//! Routes through doors compared with lengths computed by hand.

use phase_model::{
    Layout, SlotId, Vec2, arena,
    layout::{DOOR_CLEARANCE, room_of},
};
use phase_navigation::{Crossing, Gaps, IMPASSABLE_COST, Map, Route};
use proptest::prelude::*;

/// Layout 4: full wall between rooms 0 and 1, a narrow door (x 6 to 8.5) between 0 and 3, the rest open.
fn narrow() -> Map {
    Map::new(Layout::new(4, None).expect("layout 4"))
}

/// The route between two points that are connected, without bodies in doors.
fn route(map: &Map, from: Vec2, to: Vec2, width: f32) -> Route {
    map.route(from, to, width, map.gaps(), IMPASSABLE_COST).expect("the points are connected")
}

#[test]
fn in_one_room_the_way_is_straight() {
    let map = narrow();
    let from = Vec2::new(8.0, 20.0);
    let to = Vec2::new(14.0, 14.0);
    let route = route(&map, from, to, 2.4);
    assert!((route.length - from.distance(to)).abs() < 1e-4);
    assert_eq!(route.doors(), []);
}

#[test]
fn a_narrow_door_is_crossed_in_its_middle() {
    let map = narrow();
    let from = Vec2::new(14.0, 14.0);
    let to = Vec2::new(14.0, 10.0);
    let route = route(&map, from, to, 2.4);
    // The gap of 2.5 leaves a body of width 2.4 no choice: x = 7.25.
    let crossing = Vec2::new(7.25, 12.0);
    assert!((route.length - 2.0 * from.distance(crossing)).abs() < 0.2, "{}", route.length);
    assert_eq!(route.impassable, 0);
}

#[test]
fn places_on_a_way_are_measured_along_it() {
    let map = narrow();
    let (from, to) = (Vec2::new(14.0, 14.0), Vec2::new(14.0, 10.0));
    let route = route(&map, from, to, 2.4);
    let crossing = route.doors()[0].1;
    let first = from.distance(crossing);
    let halfway = from.lerp(crossing, 0.5);
    assert!(route.at(from, to, 0.0).distance(from) < 1e-4);
    assert!(route.at(from, to, 0.5 * first).distance(halfway) < 1e-4);
    assert!(route.at(from, to, first).distance(crossing) < 1e-4);
    let beyond = crossing + (to - crossing).normalize();
    assert!(route.at(from, to, first + 1.0).distance(beyond) < 1e-4);
    assert!(route.at(from, to, 100.0).distance(to) < 1e-4, "farther than the route is long");
}

#[test]
fn who_does_not_fit_pays_for_it() {
    let map = narrow();
    let from = Vec2::new(7.0, 14.0);
    let to = Vec2::new(7.0, 10.0);
    let route = route(&map, from, to, 3.6);
    assert_eq!(route.impassable, 1);
    assert!(route.cost > IMPASSABLE_COST);
}

#[test]
fn the_shorter_way_round_is_taken() {
    // Layout 2: full wall up, half wall left, nothing right and down: from room 1 to room 0 leads through
    // rooms 2 and 3.
    let map = Map::new(Layout::new(2, None).unwrap());
    let route = route(&map, Vec2::new(18.0, 20.0), Vec2::new(14.0, 20.0), 2.4);
    let slots: Vec<SlotId> = route.doors().iter().map(|&(slot, _)| slot).collect();
    assert_eq!(slots, [SlotId::RIGHT, SlotId::DOWN, SlotId::LEFT]);
}

#[test]
fn obstacles_narrow_doors() {
    let map = narrow();
    // (centre, radius, reach, remaining part of the left slot's door, from 7.5 to 10)
    let cases = [
        (Vec2::new(7.25, 12.0), 0.8, 1.6, Some((7.5_f32, 7.95_f32))),
        (Vec2::new(8.5, 12.0), 0.8, 1.6, Some((8.3, 10.0))),
        (Vec2::new(7.25, 12.0), 1.6, 2.4, None),
        (Vec2::new(7.25, 14.5), 1.6, 2.4, Some((7.5, 10.0))),
        (Vec2::new(12.0, 12.0), 0.8, 1.6, Some((7.5, 10.0))),
    ];
    for (centre, radius, reach, left) in cases {
        let mut gaps = *map.gaps();
        gaps.obstruct(centre, radius, reach);
        match (gaps.0[1], left) {
            (Some(found), Some(expected)) => {
                assert!((found.0 - expected.0).abs() < 1e-4, "{centre} {found:?} {expected:?}");
                assert!((found.1 - expected.1).abs() < 1e-4, "{centre} {found:?} {expected:?}");
            }
            (found, expected) => assert_eq!(found, expected, "{centre}"),
        }
    }
}

#[test]
fn a_gap_that_rounding_turns_upside_down_is_no_panic() {
    let map = narrow();
    for step in 0..2000 {
        let mut gaps = *map.gaps();
        gaps.0[1] = Some((7.5 + step as f32 * 1e-3, 10.0 - step as f32 * 3e-4));
        let route =
            map.route(Vec2::new(7.0, 14.0), Vec2::new(9.0, 10.0), 4.8, &gaps, IMPASSABLE_COST).unwrap();
        assert!(route.length.is_finite());
    }
}

/// The cost of a way through the best of nine points of each door between which the body fits (u).
fn cost_through_points_of_doors(
    way: &[Crossing],
    (from, to): (Vec2, Vec2),
    width: f32,
    gaps: &Gaps,
    impassable: f32,
) -> f32 {
    let mut costs = vec![(from, 0.0)];
    for door in way {
        let opening = &door.opening;
        let outwards = (opening.b - opening.a).normalize();
        let whole = (opening.a.distance(arena::CENTRE), opening.b.distance(arena::CENTRE));
        let (low, high) = gaps.0[door.slot].unwrap_or(whole);
        let margin = (0.5 * width + DOOR_CLEARANCE).min(0.5 * (high - low));
        let price = if gaps.width(door.slot) < width { impassable } else { 0.0 };
        let point = |k: u8| {
            let along = low + margin + (high - low - 2.0 * margin) * f32::from(k) / 8.0;
            let point = arena::CENTRE + outwards * along;
            let before = costs.iter().map(|&(last, cost)| cost + point.distance(last));
            (point, price + before.fold(f32::INFINITY, f32::min))
        };
        costs = (0..9).map(point).collect();
    }
    costs.iter().map(|&(last, cost)| cost + last.distance(to)).fold(f32::INFINITY, f32::min)
}

fn point() -> impl Strategy<Value = Vec2> {
    (6.5..25.5_f32, 2.5..21.5_f32).prop_map(|(x, y)| Vec2::new(x, y))
}

proptest! {
    #[test]
    fn a_way_is_as_long_in_both_directions_and_never_shorter_than_straight(
        index in 0..90_usize, from in point(), to in point()
    ) {
        let layout = Layout::all_used().nth(index).unwrap();
        let map = Map::new(layout);
        let there = route(&map, from, to, 2.4);
        let back = route(&map, to, from, 2.4);
        prop_assert!(there.length >= from.distance(to) - 1e-3);
        prop_assert!((there.length - back.length).abs() < 0.3, "{} {}", there.length, back.length);
    }

    #[test]
    fn no_other_way_through_doors_is_cheaper(
        index in 0..90_usize,
        (from, to, body) in (point(), point(), point()),
        width in 1.0..4.0_f32,
        impassable in 0.0..100.0_f32,
    ) {
        let map = Map::new(Layout::all_used().nth(index).expect("90 layouts"));
        let mut gaps = *map.gaps();
        gaps.obstruct(body, 1.0, 2.0);
        let route = map.route(from, to, width, &gaps, impassable).expect("the points are connected");
        for way in map.ways(room_of(from), room_of(to)) {
            let cost = cost_through_points_of_doors(way, (from, to), width, &gaps, impassable);
            prop_assert!(route.cost <= cost + 0.1, "{} {cost} {way:?}", route.cost);
        }
    }

    #[test]
    fn the_legs_of_a_way_cross_no_wall(index in 0..90_usize, from in point(), to in point()) {
        let layout = Layout::all_used().nth(index).unwrap();
        let map = Map::new(layout);
        let route = route(&map, from, to, 2.4);
        let points: Vec<Vec2> = core::iter::once(from)
            .chain(route.doors().iter().map(|&(_, point)| point))
            .chain(core::iter::once(to))
            .collect();
        for leg in points.windows(2) {
            let leg = phase_model::Segment { a: leg[0], b: leg[1] };
            for wall in layout.walls() {
                prop_assert!(!leg.crosses(wall), "{leg:?} {wall:?}");
            }
        }
    }
}
