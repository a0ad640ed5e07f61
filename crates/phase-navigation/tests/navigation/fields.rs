//! Distance fields against an independent search for shortest paths, and against lengths computed by hand.

use crate::oracle;

use oracle::Oracle;
use phase_model::{Flip, Layout, RoomId, Vec2, arena, layout::room_of};
use phase_navigation::{Disc, Field, Map, Mover, NavigationParameters, Navigator, Target};
use proptest::prelude::*;

const COSTS: NavigationParameters =
    NavigationParameters { impassable: 10.0, obstruction: 4.0, ..NavigationParameters::DEFAULT };

fn field(layout: Layout, target: Vec2, half_width: f32, obstacles: &[Disc]) -> Field {
    Field::new(&Map::new(layout), Target::Point(target), Mover { half_width }, obstacles, COSTS)
}

fn layout(base: u8) -> Layout {
    Layout::new(base, None).expect("a base number")
}

fn layouts() -> impl Strategy<Value = Layout> {
    (0_u8..22, proptest::option::of(0_usize..4))
        .prop_map(|(base, flip)| Layout::new(base, flip.map(|flip| Flip::ALL[flip])).expect("a base number"))
}

fn points() -> impl Strategy<Value = Vec2> {
    (6.5_f32..25.5, 2.5_f32..21.5).prop_map(|(x, y)| Vec2::new(x, y))
}

fn half_widths() -> impl Strategy<Value = f32> {
    proptest::sample::select(vec![0.8, 1.01, 1.2, 1.5, 1.6, 1.8, 2.4])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn distances_are_those_of_shortest_paths(
        layout in layouts(), from in points(), to in points(), half_width in half_widths(),
    ) {
        let oracle = Oracle::new(layout, half_width, COSTS.impassable);
        // In the margin of a corner the cost is a matter of definition.
        prop_assume!(!oracle.is_in_margin(from) && !oracle.is_in_margin(to));
        // On the line of a door, the search's tolerances decide.
        prop_assume!([from, to].iter().all(|point| (*point - arena::CENTRE).abs().min_element() > 0.01));
        let expected = oracle.distance(from, to);
        let distance = field(layout, to, half_width, &[]).distance(from);
        prop_assert!(distance >= from.distance(to) - 1e-3);
        let tolerance = (0.03 * expected).max(0.3);
        prop_assert!((distance - expected).abs() <= tolerance, "{distance}, exact {expected}");
    }

    #[test]
    fn distances_are_symmetric(
        layout in layouts(), a in points(), b in points(), half_width in half_widths(), at in points(),
    ) {
        let obstacles = [Disc { centre: at, radius: 1.0 }];
        let there = field(layout, b, half_width, &obstacles).distance(a);
        let back = field(layout, a, half_width, &obstacles).distance(b);
        prop_assert!((there - back).abs() <= 1e-2, "{there}, {back}");
    }

    #[test]
    fn distances_are_continuous_inside_a_room(
        layout in layouts(), from in points(), to in points(), half_width in half_widths(), at in points(),
        angle in 0.0_f32..6.3,
    ) {
        const STEP: f32 = 1e-4;
        let next = from + STEP * Vec2::from_angle(angle);
        prop_assume!(room_of(from) == room_of(next));
        let field = field(layout, to, half_width, &[Disc { centre: at, radius: 1.0 }]);
        let here = field.distance(from);
        let there = field.distance(next);
        // The chord of a circle grows from 0 as the root of the depth of the cut.
        let steepest = COSTS.obstruction + 2.0 * 3.0;
        let largest_radius = 3.0_f32;
        let bound = 2.0 * steepest * (2.0 * largest_radius * STEP).sqrt() + (1.0 + steepest) * STEP;
        prop_assert!((here - there).abs() <= bound, "{here}, {there}");
    }

    #[test]
    fn following_the_direction_arrives(
        layout in layouts(), from in points(), to in points(), half_width in half_widths(), at in points(),
    ) {
        let field = field(layout, to, half_width, &[Disc { centre: at, radius: 1.0 }]);
        let walls = Map::new(layout).walls().to_vec();
        let distance = field.distance(from);
        let mut place = from;
        let mut length = 0.0;
        while place.distance(to) > 0.2 {
            let direction = field.direction(place);
            prop_assert!((direction.length() - 1.0).abs() < 1e-3);
            let next = place + 0.2 * direction;
            let step = phase_model::Segment { a: place, b: next };
            prop_assert!(walls.iter().all(|wall| !wall.crosses(step)), "through a wall at {place}");
            (place, length) = (next, length + 0.2);
            prop_assert!(length <= 1.1 * distance + 0.5, "{length} of {distance} at {place}");
        }
    }

    #[test]
    fn a_room_is_as_far_as_its_nearest_point(
        layout in layouts(), from in points(), half_width in 0.8_f32..1.25, room in 0_usize..4,
    ) {
        prop_assume!(!Oracle::new(layout, half_width, COSTS.impassable).is_in_margin(from));
        let room = RoomId::ALL[room];
        let map = Map::new(layout);
        let target = Target::Room { room, depth: 1.5 };
        let distance = Field::new(&map, target, Mover { half_width }, &[], COSTS).distance(from);
        let mut nearest = f32::INFINITY;
        for (x, y) in (-1..=41).flat_map(|x| (-1..=41).map(move |y| (x, y))) {
            let to = arena::MIN + 0.5 * Vec2::new(x as f32, y as f32);
            let offset = (to - arena::CENTRE).abs();
            // Only the border of the target area can be nearest.
            let is_on_border = offset.min_element() == 1.5;
            if room_of(to) == room && is_on_border {
                nearest = nearest.min(field(layout, to, half_width, &[]).distance(from));
            }
        }
        let offset = (from - arena::CENTRE).abs();
        if room_of(from) == room && offset.min_element() >= 1.5 {
            prop_assert_eq!(distance, 0.0);
        } else {
            let tolerance = (0.03 * nearest).max(0.3);
            prop_assert!((distance - nearest).abs() <= tolerance, "{distance}, {nearest}");
        }
    }

    #[test]
    fn one_obstacle_is_passed_along_its_tangents(from in points(), to in points(), radius in 0.5_f32..1.6) {
        // No walls; a disc in the middle of the arena, so steep that the way leads around it.
        let centre = Vec2::new(16.0, 12.0);
        let grown = radius + 1.0;
        // The points at which paths bend form a ring around the disc, and legs to a place inside the ring may
        // cut the disc, at the price of these costs.
        let ring = 1.02 * grown + 0.01;
        prop_assume!(from.distance(centre) > ring && to.distance(centre) > ring);
        let costs = NavigationParameters { obstruction: 100.0, ..COSTS };
        let disc = Disc { centre, radius };
        let map = Map::new(layout(0));
        let field = Field::new(&map, Target::Point(to), Mover { half_width: 1.0 }, &[disc], costs);
        let nearest = phase_model::Segment { a: from, b: to }.distance(centre);
        let expected = if nearest >= grown {
            from.distance(to)
        } else {
            let reach = |point: Vec2| (point.distance_squared(centre) - grown * grown).sqrt();
            let turn = |point: Vec2| (grown / point.distance(centre)).acos();
            let angle = (from - centre).angle_to(to - centre).abs() - turn(from) - turn(to);
            reach(from) + reach(to) + grown * angle
        };
        let distance = field.distance(from);
        prop_assert!(distance >= expected - 1e-2, "{distance}, exact {expected}");
        prop_assert!(distance <= expected + (0.05 * expected).max(0.4), "{distance}, exact {expected}");
    }
}

#[test]
fn every_point_of_every_layout_has_a_finite_distance() {
    let corner = Vec2::new(8.5, 19.5);
    for layout in Layout::all_used() {
        let on_an_axis = [arena::CENTRE, Vec2::new(16.0, 18.0), Vec2::new(7.25, 12.0), Vec2::new(25.0, 12.0)];
        for (target, half_width) in [(corner, 1.2)].into_iter().chain(on_an_axis.map(|point| (point, 2.4))) {
            let field = field(layout, target, half_width, &[]);
            for (x, y) in (-1..=41).flat_map(|x| (-1..=41).map(move |y| (x, y))) {
                let from = arena::MIN + 0.5 * Vec2::new(x as f32, y as f32);
                let distance = field.distance(from);
                assert!(distance.is_finite() && distance >= 0.0, "{layout:?} {from}: {distance}");
                assert!(field.direction(from).is_finite());
            }
        }
    }
}

/// Layout 4: full wall above the centre, a door of 2.5 u (x 6 to 8.5) on the left, the rest open.
#[test]
fn a_closed_door_costs_its_price_or_the_way_around() {
    let from = Vec2::new(7.25, 14.0);
    let to = Vec2::new(7.25, 10.0);
    let narrow = field(layout(4), to, 1.2, &[]);
    assert!((narrow.distance(from) - 4.0).abs() < 0.05);
    assert_eq!(narrow.closed_doors(from), 0);
    let wide = field(layout(4), to, 1.3, &[]);
    assert!((wide.distance(from) - 14.0).abs() < 1e-3);
    assert_eq!(wide.closed_doors(from), 1);
    assert!(wide.direction(from).distance(Vec2::NEG_Y) < 1e-3);
}

/// Layout 6: full wall above the centre, a wall from the centre half-way down; the left and right are open,
/// and below the centre there is a door of 5 u.
#[test]
fn who_does_not_fit_one_door_takes_another() {
    let layout = layout(6);
    let map = Map::new(layout);
    let from = Vec2::new(12.0, 18.0);
    let to = Vec2::new(20.0, 18.0);
    let fits = field(layout, to, 2.4, &[]);
    assert_eq!(fits.closed_doors(from), 0);
    // Down on the left, around the end of the wall at (16, 7), up on the right; at least to (16, 4.5) and
    // back.
    let crossing = Vec2::new(16.0, 4.5);
    assert!(fits.distance(from) >= from.distance(crossing) + crossing.distance(to));
    assert!(map.fits(phase_model::SlotId::DOWN, Mover { half_width: 2.5 }));
    assert!(!map.fits(phase_model::SlotId::UP, Mover { half_width: 0.1 }));
}

#[test]
fn a_body_in_a_door_costs_and_is_passed_where_there_is_another_way() {
    // A door of 5 u on the left and one below, walls above (full).
    let layout = layout(7);
    let from = Vec2::new(8.5, 14.0);
    let to = Vec2::new(8.5, 10.0);
    let free = field(layout, to, 1.0, &[]);
    let blocked = field(layout, to, 1.0, &[Disc { centre: Vec2::new(8.5, 12.0), radius: 1.0 }]);
    assert!((free.distance(from) - 4.0).abs() < 1e-3);
    // Straight through: four units of chord at a price of 4 each.
    assert!(blocked.distance(from) > 4.0 && blocked.distance(from) <= 4.0 + 16.0 + 1e-3);
    // In the middle of a room there is always a way around.
    let beside = Disc { centre: Vec2::new(11.0, 7.0), radius: 1.0 };
    let a = Vec2::new(8.0, 7.0);
    let b = Vec2::new(14.0, 7.0);
    let distance = field(layout, b, 1.0, &[beside]).distance(a);
    assert!(distance > 6.5 && distance < 8.5, "{distance}");
}

/// Layout 6 has a door below the centre. Its line can be reached near the corner of the door, from the left
/// in a straight line and from the right around the corner.
#[test]
fn distances_to_and_from_the_line_of_a_door_are_symmetric() {
    let layout = layout(6);
    let apart = [0.0, 2e-6, 1e-5, 7e-4, 1e-3, 2e-3];
    for offset in apart.into_iter().flat_map(|apart| [-apart, apart]) {
        let a = Vec2::new(16.0 + offset, 2.5);
        for b in [Vec2::new(6.5, 2.5), Vec2::new(25.0, 2.5), Vec2::new(20.0, 18.0)] {
            let there = field(layout, b, 0.8, &[]).distance(a);
            let back = field(layout, a, 0.8, &[]).distance(b);
            assert!((there - back).abs() <= 1e-2, "{a} to {b}: {there}, back {back}");
        }
    }
}

#[test]
fn the_cache_does_not_change_answers() {
    let layout = layout(16);
    let mut navigator = Navigator::new(layout, COSTS);
    let mover = Mover { half_width: 1.2 };
    let from = Vec2::new(24.0, 4.0);
    for round in 0..2 {
        for k in 0..100 {
            let target = Vec2::new(7.0 + 0.1 * k as f32, 19.0);
            let cached = navigator.field(Target::Point(target), mover, &[]).distance(from);
            let fresh = field(layout, target, 1.2, &[]).distance(from);
            assert_eq!(cached.to_bits(), fresh.to_bits(), "round {round}");
        }
    }
}
