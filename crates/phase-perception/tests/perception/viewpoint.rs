//! The field of view: drawn cases, and agreement with the slow reference.

use crate::{
    common::{AWAY, BALL, BOX, ME, OTHER, any_physique, any_state, looking, physics, wall, with},
    oracle::look,
};
use core::f32::consts::{FRAC_PI_2, PI};
use phase_model::{AgentId, Body, Segment, Size, State, Vec2};
use phase_perception::{Cell, CellSet, Viewpoint, field_of_view, footprint, sees};
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

fn check(walls: &[Segment], state: &State, expected: [&str; 20]) {
    let physics = physics(walls.to_vec(), Size::Small);
    let seen = drawn(&field_of_view(&physics, state, AgentId::ZERO));
    assert_eq!(seen, expected, "seen:\n{}\n", seen.join("\n"));
}

#[test]
fn an_empty_room_is_seen_as_far_as_the_cone_reaches() {
    // The apex is at y = 6.367, and 24/17 cells more come into view with every row.
    check(
        &[],
        &looking((16.5, 6.5), 0.0),
        [
            "oooooooooooooooooooo",
            "oooooooooooooooooooo",
            "oooooooooooooooooooo",
            "oooooooooooooooooooo",
            "oooooooooooooooooooo",
            "oooooooooooooooooooo",
            "oooooooooooooooooooo",
            "oooooooooooooooooooo",
            "oooooooooooooooooooo",
            "..ooooooooooooooooo.",
            "...ooooooooooooooo..",
            ".....ooooooooooo....",
            "......ooooooooo.....",
            ".......ooooooo......",
            ".........ooo........",
            "..........o.........",
            "....................",
            "....................",
            "....................",
            "....................",
        ],
    );
}

#[test]
fn through_a_door_one_sees_a_strip() {
    check(
        &[wall((16.0, 12.0), (6.0, 12.0)), wall((18.5, 12.0), (26.0, 12.0))],
        &looking((14.5, 6.5), 0.0),
        [
            ".............oooooo.",
            "............ooooooo.",
            "............oooooo..",
            "............ooooo...",
            "...........ooooo....",
            "...........ooooo....",
            "...........oooo.....",
            "...........ooo......",
            "..........oooo......",
            "..........ooo.......",
            ".ooooooooooooooo....",
            "...ooooooooooo......",
            "....ooooooooo.......",
            ".....ooooooo........",
            ".......ooo..........",
            "........o...........",
            "....................",
            "....................",
            "....................",
            "....................",
        ],
    );
}

#[test]
fn objects_and_agents_cast_shadows() {
    // Facing right; an object straight ahead at (13, 12), the other agent at (20, 17).
    check(
        &[],
        &with(with(looking((8.5, 12.0), -FRAC_PI_2), BALL, (13.0, 12.0)), OTHER, (20.0, 17.0)),
        [
            ".........ooooooooooo",
            "........oooooooooooo",
            "........oooooooooo..",
            ".......oooooooo.....",
            "......oooooooo....oo",
            "......ooooooo..ooooo",
            ".....ooooooooooooooo",
            "....ooooooooooooo...",
            "...oooooooo.........",
            "...ooo..............",
            "...ooo..............",
            "...oooooooo.........",
            "....ooooooooooooo...",
            ".....ooooooooooooooo",
            "......oooooooooooooo",
            "......oooooooooooooo",
            ".......ooooooooooooo",
            "........oooooooooooo",
            "........oooooooooooo",
            ".........ooooooooooo",
        ],
    );
}

#[test]
fn the_cone_ends_at_its_half_angle() {
    // The apex at (10.5, 4.5 − 0.8/6); seen from there, (x, y) is at tan = |x − 10.5| / (y − apex).
    let apex_y = 4.5 - 0.8 / 6.0;
    let upright = |angle: f32| {
        let mut state = looking((10.5, 4.5), angle);
        // Turning is about the origin, but the apex should stay.
        state.body_mut(ME).position = Vec2::new(10.5, apex_y) + state.body(ME).forward() * (0.8 / 6.0);
        state
    };
    let edge = 54.69_f32.to_radians();
    let target = Vec2::new(15.5, 9.5);
    let towards = arc_tangent(target.x - 10.5, target.y - apex_y);
    let cases = [
        ("on the axis", -towards, true),
        ("just inside, to the left of the axis", -towards - edge + 0.001, true),
        ("just outside, to the left", -towards - edge - 0.001, false),
        ("just inside, to the right", -towards + edge - 0.001, true),
        ("just outside, to the right", -towards + edge + 0.001, false),
        ("right behind", -towards + PI, false),
        ("a full turn on", -towards + 2.0 * PI, true),
    ];
    let physics = physics(Vec::new(), Size::Small);
    let cell = Cell::at(target).unwrap();
    for (name, angle, expected) in cases {
        assert_eq!(
            field_of_view(&physics, &upright(angle), AgentId::ZERO).contains(cell),
            expected,
            "{name}"
        );
    }
}

#[test]
fn a_ray_along_a_wall_passes_and_one_through_its_end_does_not() {
    let cell = Cell::at(Vec2::new(10.5, 15.5)).unwrap();
    let cases = [
        ("clear of the end", wall((11.0, 10.0), (26.0, 10.0)), true),
        ("through the end", wall((10.5, 10.0), (26.0, 10.0)), false),
        ("across", wall((6.0, 10.0), (26.0, 10.0)), false),
        ("along", wall((11.0, 4.0), (11.0, 22.0)), true),
        ("short of the wall", wall((6.0, 16.0), (26.0, 16.0)), true),
        ("behind", wall((6.0, 3.0), (26.0, 3.0)), true),
    ];
    for (name, wall, expected) in cases {
        let state = looking((10.5, 4.5), 0.0);
        assert_eq!(
            field_of_view(&physics(vec![wall], Size::Small), &state, AgentId::ZERO).contains(cell),
            expected,
            "{name}"
        );
    }
}

#[test]
fn entities_are_seen_if_a_cell_of_theirs_is() {
    let front = looking((10.5, 6.5), 0.0);
    let huge = |state: State| (Size::Huge, state);
    let small = |state: State| (Size::Small, state);
    let cases = [
        ("straight ahead", small(with(front, BALL, (10.5, 15.0))), true),
        (
            "right before the head, too large to see its cells past it",
            huge(with(front, BALL, (10.5, 9.8))),
            true,
        ),
        ("behind", small(with(front, BALL, (10.5, 3.0))), false),
        ("beside", small(with(front, BALL, (13.0, 6.0))), false),
        ("only the far side in the cone", small(with(front, BALL, (13.3, 8.0))), true),
        (
            "behind a smaller one of the same bearing",
            small(with(with(front, BOX, (10.5, 10.5)), BALL, (10.5, 13.5))),
            false,
        ),
        ("behind the other agent", small(with(with(front, OTHER, (10.5, 9.5)), BALL, (10.5, 13.0))), false),
        (
            "half behind the other agent",
            small(with(with(front, OTHER, (10.5, 12.5)), BALL, (12.6, 16.5))),
            true,
        ),
        ("nowhere", small(with(front, BALL, (AWAY.x, AWAY.y))), false),
        ("not a number", small(with(front, BALL, (f32::NAN, 10.0))), false),
    ];
    for (name, (size, state), expected) in cases {
        assert_eq!(sees(&physics(Vec::new(), size), &state, AgentId::ZERO, BALL), expected, "{name}");
    }
}

#[test]
fn walls_hide_entities_and_doors_show_them() {
    let walls = || vec![wall((16.0, 12.0), (6.0, 12.0)), wall((18.5, 12.0), (26.0, 12.0))];
    let cases = [((12.0, 14.0), false), ((17.2, 13.0), true), ((18.5, 20.0), true), ((23.0, 14.0), false)];
    for (place, expected) in cases {
        let state = with(looking((14.5, 6.5), 0.0), BALL, place);
        assert_eq!(sees(&physics(walls(), Size::Small), &state, AgentId::ZERO, BALL), expected, "{place:?}");
    }
}

#[test]
fn nobody_sees_itself_or_what_is_not_there() {
    let mut physics = physics(Vec::new(), Size::Small);
    let state = with(looking((10.5, 6.5), 0.0), BOX, (10.5, 12.0));
    assert!(!sees(&physics, &state, AgentId::ZERO, ME));
    assert!(sees(&physics, &state, AgentId::ZERO, BOX));
    physics.object_count = 1;
    assert!(!sees(&physics, &state, AgentId::ZERO, BOX));
}

#[test]
fn a_wall_through_the_eye_hides_nothing() {
    let walls = vec![wall((10.5, 4.0), (10.5, 5.0))];
    let state = looking((10.5, 4.5), 0.0);
    let seen = field_of_view(&physics(walls, Size::Small), &state, AgentId::ZERO);
    assert_eq!(seen, field_of_view(&physics(Vec::new(), Size::Small), &state, AgentId::ZERO));
    assert!(seen.len() > 100);
}

#[test]
fn a_body_that_has_gone_hides_nothing() {
    let physics = physics(Vec::new(), Size::Small);
    let alone = looking((16.5, 6.5), 0.0);
    let state = with(alone, OTHER, (16.5, 10.5));
    let seen = |state: &State| field_of_view(&physics, state, AgentId::ZERO);
    assert!(seen(&state).len() < seen(&alone).len());
    let view = Viewpoint::new(&physics, &state, AgentId::ZERO).without(OTHER);
    assert_eq!(Cell::all().filter(|&cell| view.sees_cell(cell)).collect::<CellSet>(), seen(&alone));
}

/// The angle whose tangent is x/y; the heading towards (x, y) is its negative.
fn arc_tangent(x: f32, y: f32) -> f32 {
    x.atan2(y)
}

proptest! {
    #[test]
    fn cells_are_seen_as_reckoned_slowly(
        physics in any_physique(),
        state in any_state(),
        agent in 0_usize..2,
    ) {
        let visible = field_of_view(&physics, &state, AgentId::ALL[agent]);
        for cell in Cell::all() {
            let sight = look(&physics, &state, agent, cell);
            prop_assert!(
                sight.margin < 1e-3 || visible.contains(cell) == sight.visible,
                "{cell:?}, margin {}", sight.margin
            );
        }
    }

    /// An entity is seen exactly if its cells would be visible without it.
    #[test]
    fn entities_are_seen_as_if_they_hid_nothing(
        physics in any_physique(), state in any_state(), agent in 0_usize..2,
    ) {
        for entity in physics.entities().filter(|entity| entity.index() != agent) {
            let mut without = state;
            *without.body_mut(entity) = Body::at_rest(AWAY, 0.0);
            let cells = footprint(&physics, entity, state.body(entity));
            let expected = field_of_view(&physics, &without, AgentId::ALL[agent]).intersects(&cells);
            prop_assert_eq!(sees(&physics, &state, AgentId::ALL[agent], entity), expected, "{:?}", entity);
        }
    }

    /// No number causes a panic, and an eye at an invalid position sees nothing of the arena.
    #[test]
    fn any_numbers_will_do(numbers in prop::array::uniform12(prop::num::f32::ANY), agent in 0_usize..2) {
        let body = |k: usize| Body::at_rest(Vec2::new(numbers[k], numbers[k + 1]), numbers[k + 2]);
        let state = State::new([body(0), body(3), body(6), body(9)]);
        let physics = physics(vec![wall((16.0, 12.0), (6.0, 12.0))], Size::Large);
        let visible = field_of_view(&physics, &state, AgentId::ALL[agent]);
        if !state.bodies[agent].is_finite() {
            prop_assert!(visible.is_empty());
        }
        for entity in physics.entities() {
            let _ = sees(&physics, &state, AgentId::ALL[agent], entity);
        }
    }
}
