//! No body escapes, explodes or becomes NaN, whatever the start and the actions.

use crate::physics;
use phase_model::{
    Action, AgentId, Body, Entity, Flip, Grip, Layout, ObjectId, PhysicsConfig, Segment, Side, Size, State,
    Strength, Vec2, arena, geometry::Outline,
};
use phase_world::World;
use proptest::prelude::*;

/// A speed that no body reaches by pushing across the whole arena: √(2 · 20 u · 500 N / 2.56 kg) is 88 u/s.
const SPEED_LIMIT: f32 = 100.0;

fn layout() -> impl Strategy<Value = Layout> {
    let flip = prop::option::of(prop::sample::select(Flip::ALL.to_vec()));
    (0..22u8, flip).prop_map(|(base, flip)| Layout::new(base, flip).expect("base up to 21"))
}

fn size() -> impl Strategy<Value = Size> {
    prop::sample::select(Size::ALL.to_vec())
}

fn agent() -> impl Strategy<Value = (Size, Strength)> {
    (size(), prop::sample::select(Strength::ALL.to_vec()))
}

/// Start points of all rooms, so few that bodies often coincide; large ones overlap the walls nearby.
fn start() -> impl Strategy<Value = Body> {
    (0..4usize, 0..4usize, -7.0..7.0f32)
        .prop_map(|(room, point, angle)| Body::at_rest(arena::START_POINTS[room][point], angle))
}

fn actions() -> impl Strategy<Value = Vec<[Action; 2]>> {
    let action = || prop::sample::select(Action::ALL.to_vec());
    // Long pushes in one direction reach the highest speeds.
    let stretch = (action(), action(), 1..8usize).prop_map(|(a, b, steps)| vec![[a, b]; steps]);
    prop::collection::vec(stretch, 1..10).prop_map(|stretches| stretches.concat())
}

/// Runs a scene and checks every substep.
fn check(physics: &PhysicsConfig, start: &State, actions: &[[Action; 2]]) {
    let mut world = World::new(physics, start);
    let mut before = world.state();
    let first = [world.settle()];
    let states = first.into_iter().chain(actions.iter().flat_map(|&actions| world.step(actions)));
    for state in states {
        assert!(state.is_finite(physics));
        for entity in physics.entities() {
            let way = Segment { a: before.position(entity), b: state.position(entity) };
            assert!(arena::contains(way.b), "{entity:?} left the arena: {}", way.b);
            let speed = state.body(entity).velocity.length();
            assert!(speed < SPEED_LIMIT, "{entity:?} is thrown off at {speed} u/s");
            for wall in &physics.walls {
                assert!(!wall.crosses(way), "{entity:?} went through {wall:?}: {way:?}");
            }
        }
        before = state;
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn nothing_gets_through_walls(
        layout in layout(),
        agents in [agent(), agent()],
        objects in [size(), size()],
        starts in [start(), start(), start(), start()],
        actions in actions(),
    ) {
        let mut physics = physics(agents, objects);
        physics.walls = layout.walls();
        check(&physics, &State::new(starts), &actions);
    }

    #[test]
    fn nothing_leaves_the_arena_from_any_start(
        layout in layout(),
        agents in [agent(), agent()],
        objects in [size(), size()],
        places in prop::array::uniform4((6.0..=26.0f32, 2.0..=22.0f32, -7.0..7.0f32)),
        actions in actions(),
    ) {
        let mut physics = physics(agents, objects);
        physics.walls = layout.walls();
        let start = State::new(places.map(|(x, y, angle)| Body::at_rest(Vec2::new(x, y), angle)));
        let mut world = World::new(&physics, &start);
        for state in actions.iter().flat_map(|&actions| world.step(actions)) {
            prop_assert!(state.is_finite(&physics));
            for entity in physics.entities() {
                prop_assert!(arena::contains(state.position(entity)), "{entity:?}: {:?}", state.body(entity));
            }
        }
    }

    #[test]
    fn any_state_is_survived(
        numbers in prop::collection::vec(prop::num::f32::ANY, 24),
        grips in prop::collection::vec(prop::option::of((0..2usize, 0..4usize, prop::num::f32::ANY)), 2),
        count in 0..=2usize,
    ) {
        let mut physics = physics([(Size::Small, Strength::Mighty); 2], [Size::Large; 2]);
        physics.object_count = count;
        let body = |k: usize| Body {
            position: Vec2::new(numbers[k], numbers[k + 1]),
            velocity: Vec2::new(numbers[k + 2], numbers[k + 3]),
            angle: numbers[k + 4],
            angular_velocity: numbers[k + 5],
        };
        let mut state = State::new([0, 6, 12, 18].map(body));
        for (slot, grip) in state.grips.iter_mut().zip(&grips) {
            *slot = grip.map(|(object, side, relative_angle)| Grip {
                object: ObjectId::ALL[object],
                side: Side::ALL[side],
                relative_angle,
            });
        }
        let mut world = World::new(&physics, &state);
        for _ in 0..3 {
            let state = world.step([Action::Up, Action::TurnLeft])[4];
            prop_assert!(state.is_finite(&physics));
            for entity in physics.entities() {
                prop_assert!(arena::contains(state.position(entity)));
            }
        }
    }
}

#[test]
fn bodies_that_start_in_one_place_come_apart() {
    for size in Size::ALL {
        for point in
            [arena::START_POINTS[0][0], arena::START_POINTS[0][2], arena::CENTRE + Vec2::new(3.0, 3.0)]
        {
            let physics = physics([(size, Strength::Fair); 2], [size; 2]);
            let mut world = World::new(&physics, &State::new([Body::at_rest(point, 0.5); 4]));
            let mut last = world.settle();
            for _ in 0..30 {
                last = world.step([Action::NoForce; 2])[4];
            }
            let outlines = [0, 1, 2, 3].map(|k| {
                // Slightly smaller, because contacts at rest may overlap by a hundredth.
                let mut slim = physics.clone();
                slim.agents.iter_mut().for_each(|agent| agent.radius -= 0.02);
                slim.object_radii.iter_mut().for_each(|radius| *radius -= 0.02);
                Outline::of(&slim, Entity::ALL[k], &last.bodies[k])
            });
            for a in 0..4 {
                for b in 0..a {
                    assert!(!outlines[a].overlaps(&outlines[b]), "{size:?} at {point}: {a} and {b} overlap");
                }
                let speed = last.bodies[a].velocity.length();
                assert!(speed < 0.1, "{size:?} at {point}: {a} still moves at {speed}");
            }
        }
    }
}

#[test]
fn the_fastest_bodies_stop_at_walls() {
    for size in Size::ALL {
        let mut physics = physics([(size, Strength::Mighty); 2], [size; 2]);
        physics.walls = vec![Segment { a: Vec2::new(16.0, 2.0), b: Vec2::new(16.0, 22.0) }];
        for (index, angle) in [(0, 0.0), (0, 1.1), (0, -0.4), (2, 0.0)] {
            let mut bodies = [(24.0, 20.0), (24.0, 4.0), (20.0, 12.0), (24.0, 12.0)]
                .map(|(x, y)| Body::at_rest(Vec2::new(x, y), 0.0));
            bodies[index] = Body {
                velocity: Vec2::new(115.0, 9.0),
                angular_velocity: 20.0,
                ..Body::at_rest(Vec2::new(9.0, 12.0), angle)
            };
            let mut world = World::new(&physics, &State::new(bodies));
            for _ in 0..4 {
                for state in world.step([Action::NoForce; 2]) {
                    let x = state.bodies[index].position.x;
                    assert!(x < 16.0 - 0.4 * size.radius(), "{size:?} {index} {angle}: x {x}");
                }
            }
        }
    }
}

#[test]
fn grips_do_not_pull_through_walls() {
    for size in Size::ALL {
        for (gap, turn) in [(0.05, Action::Down), (0.2, Action::TurnLeft), (0.0, Action::UpRight)] {
            let mut physics = physics([(size, Strength::Mighty); 2], [size; 2]);
            let wall = Segment { a: Vec2::new(6.0, 12.0), b: Vec2::new(26.0, 12.0) };
            physics.walls = vec![wall];
            let apart = size.radius() + gap;
            let bodies = [(16.0, 12.0 - apart), (23.0, 4.0), (16.0, 12.0 + apart), (23.0, 20.0)];
            let start = State::new(bodies.map(|(x, y)| Body::at_rest(Vec2::new(x, y), 0.0)));
            let mut world = World::new(&physics, &start);
            let held = world.step([Action::Attach, Action::NoForce])[4];
            assert!(held.holds(AgentId::ZERO, ObjectId::ZERO), "{size:?} reaches through the wall");
            for step in 0..20 {
                for state in world.step([turn, Action::NoForce]) {
                    let what = format!("{size:?} {turn:?} step {step}: {:?}", state.bodies);
                    assert!(state.is_finite(&physics), "{what}");
                    assert!(state.bodies[0].position.y < 12.0 && state.bodies[2].position.y > 12.0, "{what}");
                }
            }
        }
    }
}
