//! What holds in every state and under all actions.

use phase_forward::Forward;
use phase_model::{
    Action, AgentBody, Body, Dynamics, Entity, Layout, Physique, Segment, Size, State, Strength, Vec2, arena,
    physique::object_mass,
};
use proptest::prelude::*;

fn physiques() -> impl Strategy<Value = Physique> {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let size = || prop::sample::select(Size::ALL.to_vec());
    let strength = || prop::sample::select(Strength::ALL.to_vec());
    (prop::sample::select(layouts), [size(), size(), size(), size()], [strength(), strength()], 0..=2_usize)
        .prop_map(|(layout, sizes, strengths, object_count)| Physique {
            walls: layout.walls(),
            agents: [0, 1]
                .map(|k| AgentBody { radius: sizes[k].radius(), max_force: strengths[k].max_force() }),
            object_radii: [sizes[2].radius(), sizes[3].radius()],
            object_count,
        })
}

/// Bodies anywhere in the arena, even in walls and in each other, moving at up to a hundred units a second.
fn bodies() -> impl Strategy<Value = [Body; 4]> {
    let body = || {
        (
            6.1..25.9_f32,
            2.1..21.9_f32,
            -70.0..70.0_f32,
            -70.0..70.0_f32,
            -20.0..20.0_f32,
            -30.0..30.0_f32,
            0..3_u8,
        )
            .prop_map(|(x, y, vx, vy, angle, spin, moves)| Body {
                position: Vec2::new(x, y),
                velocity: if moves == 0 { Vec2::new(vx, vy) } else { Vec2::ZERO },
                angle,
                angular_velocity: if moves == 0 { spin } else { 0.0 },
            })
    };
    [body(), body(), body(), body()]
}

fn actions(length: usize) -> impl Strategy<Value = Vec<[Action; 2]>> {
    let action = || prop::sample::select(Action::ALL.to_vec());
    prop::collection::vec(([action(), action()], 1..6_usize), length)
        .prop_map(|runs| runs.into_iter().flat_map(|(actions, times)| vec![actions; times]).collect())
}

/// Centre of mass of an entity.
fn centre(physique: &Physique, state: &State, entity: Entity) -> Vec2 {
    let body = state.body(entity);
    match entity {
        Entity::Agent(agent) => {
            body.position - body.forward() * physique.agents[usize::from(agent)].centre_of_mass_offset()
        }
        Entity::Object(_) => body.position,
    }
}

/// Whether a way crosses a wall for good: from clearly on one side to clearly on the other.
fn passes(from: Vec2, to: Vec2, wall: Segment) -> bool {
    let normal = (wall.b - wall.a).perp().normalize();
    let sides = [from, to].map(|point| normal.dot(point - wall.a));
    sides[0] * sides[1] < 0.0
        && sides.iter().all(|side| side.abs() > 1e-3)
        && Segment { a: from, b: to }.crosses(wall)
}

/// A check of what one substep did.
fn check(physique: &Physique, before: &State, after: &State) -> Result<(), TestCaseError> {
    prop_assert!(after.is_finite(physique), "{after:?}");
    for entity in physique.entities() {
        let (from, to) = (centre(physique, before, entity), centre(physique, after, entity));
        prop_assert!(arena::contains(to), "{entity:?} left the arena: {from} -> {to}");
        for &wall in &physique.walls {
            prop_assert!(!passes(from, to, wall), "{entity:?} passed {wall:?}: {from} -> {to}");
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]


    #[test]
    fn nothing_escapes_and_everything_stays_finite(
        physique in physiques(), bodies in bodies(), actions in actions(20),
    ) {
        let forward = Forward::new(&physique);
        let mut state = State::new(bodies);
        let (mut warm, mut memory) = (state, forward.remember(&state));
        for actions in actions {
            let (mut before, mut again) = (state, state);
            let substeps = forward.step_substeps(&mut state, actions);
            for (k, after) in substeps.iter().enumerate() {
                check(&physique, &before, after).map_err(|e| TestCaseError::fail(format!("substep {k}: {e}")))?;
                before = *after;
            }
            forward.step(&mut again, actions);
            prop_assert_eq!(again, state, "a step differs from its substeps");
            before = warm;
            for after in forward.step_warm(&mut warm, &mut memory, actions) {
                check(&physique, &before, &after)?;
                before = after;
            }
        }
    }

    #[test]
    fn ground_friction_only_slows(velocity in (-40.0..40.0_f32, -40.0..40.0_f32), angle in -9.0..9.0_f32, size in 0..4_usize) {
        let physique = Physique {
            walls: Vec::new(),
            agents: [AgentBody { radius: Size::ALL[size].radius(), max_force: 300.0 }; 2],
            object_radii: [1.2, 0.8],
            object_count: 1,
        };
        let forward = Forward::new(&physique);
        for (moving, other, mass) in [(0, 2, physique.agents[0].mass()), (2, 0, object_mass(1.2))] {
            let mut state = State::new([[8.0, 5.0], [24.0, 5.0], [24.0, 19.0], [8.0, 19.0]].map(|[x, y]| Body::at_rest(Vec2::new(x, y), angle)));
            state.bodies[other].position = Vec2::new(8.0, 5.0);
            state.bodies[moving].position = arena::CENTRE;
            state.bodies[moving].velocity = Vec2::new(velocity.0, velocity.1);
            let substeps = forward.step_substeps(&mut state, [Action::NoForce; 2]);
            let mut speed = Vec2::new(velocity.0, velocity.1).length();
            for after in substeps {
                let now = after.bodies[moving].velocity.length();
                prop_assert!(now <= speed + 1e-4, "{speed} -> {now}");
                // It never takes more than 100 N, and takes all of them as long as a disc slides.
                let loss = 100.0 / 60.0 / mass;
                prop_assert!(now >= speed - loss - 1e-3);
                if moving == 2 && speed > loss && speed < 40.0 {
                    prop_assert!((speed - now - loss).abs() < 1e-3, "{speed} -> {now}, not {loss}");
                }
                speed = now;
            }
        }
    }

    #[test]
    fn colliding_bodies_keep_their_momentum(offset in -1.5..1.5_f32, speed in 1.0..25.0_f32, mover in 0..4_usize, next in 1..4_usize, angle in -4.0..4.0_f32) {
        let physique = Physique {
            walls: Vec::new(),
            agents: [AgentBody { radius: 0.8, max_force: 300.0 }, AgentBody { radius: 1.2, max_force: 300.0 }],
            object_radii: [0.8, 1.2],
            object_count: 2,
        };
        let forward = Forward::new(&physique);
        let masses = [physique.agents[0].mass(), physique.agents[1].mass(), object_mass(0.8), object_mass(1.2)];
        let struck = (mover + next) % 4;
        let mut state = State::new([[8.0, 4.0], [24.0, 4.0], [24.0, 20.0], [8.0, 20.0]].map(|[x, y]| Body::at_rest(Vec2::new(x, y), angle)));
        state.bodies[mover].position = Vec2::new(12.5, 12.0);
        state.bodies[mover].velocity = Vec2::new(speed, 0.0);
        state.bodies[struck].position = Vec2::new(16.0, 12.0 + offset);
        let momentum = |state: &State| -> Vec2 { state.bodies.iter().zip(masses).map(|(body, mass)| body.velocity * mass).sum() };
        for _ in 0..6 {
            let mut before = state;
            for after in forward.step_substeps(&mut state, [Action::NoForce; 2]) {
                let change = momentum(&after).distance(momentum(&before));
                prop_assert!(change <= 2.0 * 100.0 / 60.0 + 1e-3, "momentum changed by {change}");
                before = after;
            }
        }
    }
}

#[test]
fn numbers_that_are_none_do_not_spread() {
    let physique = Physique {
        walls: Vec::new(),
        agents: [AgentBody { radius: 0.8, max_force: 300.0 }; 2],
        object_radii: [0.8; 2],
        object_count: 2,
    };
    let forward = Forward::new(&physique);
    for bad in [f32::NAN, f32::INFINITY, f32::MAX, -f32::MAX] {
        for field in 0..6 {
            let mut state =
                State::new([8.0, 12.0, 16.0, 20.0].map(|x| Body::at_rest(Vec2::new(x, 7.0), 0.0)));
            for body in &mut state.bodies {
                match field {
                    0 => body.position.x = bad,
                    1 => body.position.y = bad,
                    2 => body.velocity.x = bad,
                    3 => body.velocity.y = bad,
                    4 => body.angle = bad,
                    _ => body.angular_velocity = bad,
                }
            }
            for _ in 0..3 {
                forward.step(&mut state, [Action::Up, Action::TurnLeft]);
                assert!(state.is_finite(&physique), "field {field} = {bad}: {state:?}");
                assert!(
                    physique.entities().all(|entity| arena::contains(centre(&physique, &state, entity))),
                    "field {field} = {bad}: {state:?}"
                );
            }
        }
    }
}

#[test]
fn bodies_at_rest_stay_at_rest() {
    for layout in Layout::all_used() {
        let physique = Physique {
            walls: layout.walls(),
            agents: [AgentBody { radius: 0.8, max_force: 300.0 }; 2],
            object_radii: [0.8; 2],
            object_count: 2,
        };
        let places = [
            arena::START_POINTS[0][0],
            arena::START_POINTS[1][0],
            arena::START_POINTS[2][1],
            arena::START_POINTS[3][1],
        ];
        let start = State::new(places.map(|place| Body::at_rest(place, 0.5)));
        let mut state = start;
        for _ in 0..4 {
            Forward::new(&physique).step(&mut state, [Action::NoForce, Action::Stop]);
        }
        for (now, then) in state.bodies.iter().zip(&start.bodies) {
            assert!(now.position.distance(then.position) < 1e-5 && now.velocity == Vec2::ZERO);
        }
    }
}
