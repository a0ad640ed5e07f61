//! Fields of assemblies in cases computed by hand.

use core::f32::consts::{FRAC_PI_2, PI};
use phase_model::{
    Grip, Layout, ObjectId, PhysicsConfig, RoomId, Segment, Side, Vec2, arena, geometry::forward,
    physics::AgentBody,
};
use phase_navigation::NavigationParameters;
use phase_navigation::{Assembly, AssemblyField, AssemblyParameters, Descent, Map, Navigator, Target};
use proptest::prelude::*;

const COSTS: AssemblyParameters = AssemblyParameters { collision: 20.0, ..AssemblyParameters::DEFAULT };
/// Distance at which an object is on a landmark (u).
const REACH: f32 = 1.414;

fn grip(side: Side) -> Grip {
    Grip { object: ObjectId::ZERO, side, relative_angle: 0.0 }
}

/// An object held by one agent, or by two.
fn assembly(load: f32, agents: f32, grips: [Option<Grip>; 2]) -> Assembly {
    let physics = PhysicsConfig {
        walls: Vec::new(),
        agents: [AgentBody { radius: agents, max_force: 300.0 }; 2],
        object_radii: [load, 0.0],
        object_count: 1,
    };
    Assembly::of(&physics, &grips, ObjectId::ZERO)
}

fn held(load: f32, agent: f32, side: Side) -> Assembly {
    assembly(load, agent, [Some(grip(side)), None])
}

fn field(base: u8, target: Vec2, assembly: &Assembly) -> AssemblyField {
    field_with(COSTS, base, target, assembly)
}

fn field_with(costs: AssemblyParameters, base: u8, target: Vec2, assembly: &Assembly) -> AssemblyField {
    let map = Map::new(Layout::new(base, None).expect("a base number"));
    AssemblyField::new(&map, Target::Point(target), REACH, assembly, costs)
}

/// Layout 4 has a door of 2.5 u on the left, at x 6 to 8.5 and y 12. An agent of radius 0.8 is 2.4 u wide,
/// and 3.2 u long with an object of the same radius.
#[test]
fn a_long_assembly_aligns_with_a_door_before_it_passes() {
    let from = Vec2::new(8.75, 16.0);
    let to = Vec2::new(7.25, 6.0);
    let field = field(4, to, &held(0.8, 0.8, Side::Head));
    // With the carrier above its load.
    let aligned = field.distance(from, PI);
    assert!((aligned - from.distance(to)).abs() < 1.0, "{aligned}");
    for turn in [FRAC_PI_2, -FRAC_PI_2] {
        let misaligned = field.distance(from, PI + turn);
        assert!(misaligned > aligned + 1.0 && misaligned < aligned + 2.5, "{misaligned}, {aligned}");
        // It has turned when the load enters the door, one way or the other.
        let mut load = from;
        let mut angle = PI + turn;
        while load.y > 12.0 {
            let descent = field.descent(load, angle);
            assert!(descent != Descent { direction: Vec2::ZERO, turn: 0.0 });
            load += 0.1 * descent.direction;
            angle += 0.05 * descent.turn;
        }
        assert!(angle.sin().abs() < 0.4, "{angle}");
    }
    let on = field.descent(Vec2::new(7.25, 14.0), PI);
    assert_eq!(on.turn, 0.0);
    assert!(on.direction.distance(Vec2::NEG_Y) < 0.2, "{on:?}");
}

/// An agent of radius 1.2 is 3.6 u wide, but 2.4 u from front to back.
#[test]
fn what_does_not_fit_one_way_fits_another() {
    let from = Vec2::new(7.25, 16.0);
    let to = Vec2::new(7.25, 6.0);
    let in_front = field(4, to, &held(0.8, 1.2, Side::Head));
    let beside = field(4, to, &held(0.8, 1.2, Side::Right));
    // The load on the right of the carrier, the carrier above it: an angle of -90°.
    let passes = beside.distance(from, -FRAC_PI_2);
    assert!((passes - 10.0).abs() < 1.0, "{passes}");
    assert!(!beside.collides(Vec2::new(7.25, 10.4), -FRAC_PI_2));
    assert!(in_front.collides(Vec2::new(7.25, 10.4), PI));
    // Through the walls, or around by the lower right rooms, or turned within the door: dearer in any case.
    let stuck = in_front.distance(from, PI);
    assert!(stuck > passes + 10.0, "{stuck}");
}

/// Landmarks are 2.5 u from two sides of the arena.
#[test]
fn a_carrier_stopped_by_the_arena_turns_where_it_has_to() {
    let landmark = arena::LANDMARKS[0];
    // Load on the landmark, the carrier at its left, facing right (an angle of -90°).
    let outwards = -FRAC_PI_2;
    // 0.8 + 1.6 = 2.4 u from the landmark to the carrier's back: there is room.
    let small = field(4, landmark, &held(0.8, 0.8, Side::Head));
    assert!(!small.collides(landmark, outwards));
    assert!(small.distance(landmark, outwards) < 0.1);
    // 1.2 + 2.4 = 3.6 u: the load stops 1.1 u before it, which is near enough.
    let middle = field(4, landmark, &held(1.2, 1.2, Side::Head));
    let stopped = landmark + Vec2::new(1.2, 0.0);
    assert!(!middle.collides(stopped, outwards) && middle.collides(landmark, outwards));
    let left = middle.distance(stopped, outwards);
    assert!((left - 1.2).abs() < 0.2, "{left}");
    // 1.2 + 3.2 = 4.4 u: 1.9 u before it, not near enough without a turn.
    let large = field(4, landmark, &held(1.2, 1.6, Side::Head));
    let stopped = landmark + Vec2::new(2.0, 0.0);
    let left = large.distance(stopped, outwards);
    assert!(left > 2.1, "{left}");
}

#[test]
fn both_holders_count() {
    let both =
        assembly(0.8, 0.8, [Some(grip(Side::Head)), Some(Grip { relative_angle: PI, ..grip(Side::Head) })]);
    assert_eq!(both.holder_count(), 2);
    let field = field(0, Vec2::new(16.0, 12.0), &both);
    // One on each side, 2.4 u to either end.
    let near_top = Vec2::new(16.0, 20.0);
    assert!(field.collides(near_top, 0.0) && !field.collides(near_top, FRAC_PI_2));
    let one = held(0.8, 0.8, Side::Head);
    let field = self::field(0, Vec2::new(16.0, 12.0), &one);
    assert!(!field.collides(near_top, 0.0) && field.collides(near_top, PI));
}

#[test]
fn a_load_inside_its_room_has_arrived() {
    let map = Map::new(Layout::new(16, None).expect("layout 16"));
    let target = Target::Room { room: RoomId::TOP_RIGHT, depth: 1.5 };
    let field = AssemblyField::new(&map, target, REACH, &held(0.8, 0.8, Side::Head), COSTS);
    assert!(field.distance(Vec2::new(22.0, 17.0), 0.0) < 1e-3);
    assert!(field.distance(Vec2::new(10.0, 7.0), 0.0) > 10.0);
}

#[test]
fn the_cache_does_not_change_answers() {
    let bases = [4, 16];
    let navigators = bases.map(|base| {
        Navigator::new(Layout::new(base, None).expect("a base number"), NavigationParameters::DEFAULT)
    });
    let from = Vec2::new(8.75, 16.0);
    for round in 0..2 {
        for (side, landmark) in Side::ALL.into_iter().flat_map(|side| arena::LANDMARKS.map(|to| (side, to))) {
            let assembly = held(0.8, 0.8, side);
            for (base, navigator) in bases.into_iter().zip(&navigators) {
                let cached = navigator.assembly_field(Target::Point(landmark), REACH, &assembly, COSTS);
                let fresh = field(base, landmark, &assembly);
                assert_eq!(
                    cached.distance(from, 1.0).to_bits(),
                    fresh.distance(from, 1.0).to_bits(),
                    "{round}"
                );
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn values_are_finite_bounded_below_and_continuous(
        base in 0_u8..22, landmark in 0_usize..4, radius in 0.8_f32..1.6, load in 0.8_f32..1.2,
        places in proptest::collection::vec((6.5_f32..25.5, 2.5_f32..21.5, -7.0_f32..7.0), 200),
    ) {
        let target = arena::LANDMARKS[landmark];
        let field = field(base, target, &held(load, radius, Side::Left));
        for (x, y, angle) in places {
            let at = Vec2::new(x, y);
            let distance = field.distance(at, angle);
            prop_assert!(distance.is_finite());
            prop_assert!(distance >= at.distance(target) - 1e-3);
            let near = field.distance(at + Vec2::splat(1e-4), angle + 1e-4);
            // Values change by at most the price of collisions over 1e-4.
            prop_assert!((near - distance).abs() < 0.05, "{distance}, {near}");
            let turned = field.distance(at, angle + core::f32::consts::TAU);
            prop_assert!((turned - distance).abs() < 0.01, "{distance}, {turned}");
        }
    }

    #[test]
    fn following_the_descent_arrives_without_passing_through_walls(
        base in 0_u8..22,
        landmark in 0_usize..4,
        x in 8.0_f32..24.0,
        y in 4.0_f32..20.0,
        angle in -3.0_f32..3.0,
    ) {
        let target = arena::LANDMARKS[landmark];
        // To pass through a wall with bodies of 1.6 u costs 320 u, more than any way round that counts here.
        let costs = AssemblyParameters { collision: 200.0, ..COSTS };
        let field = field_with(costs, base, target, &held(0.8, 0.8, Side::Head));
        let mut load = Vec2::new(x, y);
        let mut angle = angle;
        prop_assume!(!field.collides(load, angle));
        let start = field.distance(load, angle);
        prop_assume!(start < 60.0);
        let walls = Layout::new(base, None).expect("a base number").walls();
        let centres = |load: Vec2, angle: f32| [load, load - 1.6 * forward(angle)];
        let mut length = 0.0;
        while load.distance(target) > REACH {
            let descent = field.descent(load, angle);
            let before = centres(load, angle);
            load += 0.1 * descent.direction;
            angle += 0.05 * descent.turn;
            length += 0.1 * descent.direction.length() + 0.05 * descent.turn.abs() * COSTS.turning;
            prop_assert!(length <= 1.5 * start + 3.0, "{length} of {start} at {load}, {angle}");
            // Nothing holds the bodies off the walls here: between two free nodes they cut corners. But no
            // centre gets to the other side of a wall.
            for (a, b) in before.into_iter().zip(centres(load, angle)) {
                prop_assert!(!walls.iter().any(|wall| wall.crosses(Segment { a, b })), "from {a} to {b}");
            }
        }
    }
}
