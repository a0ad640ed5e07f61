//! Impacts on walls within a substep, compared with hand calculations.

use crate::{assert_close, assert_share, lone_agent, lone_state, physics, step};
use phase_model::{
    Action, Body, Segment, Size, State, Strength, Vec2, arena, arena::SUBSTEP_SECONDS, geometry, physics,
};
use phase_world::World;

/// Object 0 with a velocity, all other bodies far away; the states after each substep of one step.
fn thrown(position: Vec2, velocity: Vec2) -> [State; 5] {
    let mut state = lone_state(Vec2::new(9.0, 4.0), 0.0);
    state.bodies[2] = Body { position, velocity, ..Body::default() };
    let mut world = World::new(&lone_agent(Size::Small, Strength::Weak), &state);
    world.step([Action::NoForce; 2])
}

#[test]
fn an_impact_takes_the_speed_into_the_wall_and_leaves_the_rest() {
    for (across, gap) in [(20.0_f32, 0.05), (30.0, 0.3), (60.0, 0.9), (110.0, 1.5)] {
        let along = 12.0;
        let speed = across.hypot(along);
        // Friction acts before the impact, against the direction of motion.
        let kept = 1.0 - 100.0 * SUBSTEP_SECONDS / physics::object_mass(0.8) / speed;
        let start = Vec2::new(14.0, arena::MAX.y - 0.8 - gap);
        let after = thrown(start, Vec2::new(along, across))[0].bodies[2];
        let what = format!("at {across} u/s from {gap} u");
        assert_close(after.velocity.y, 0.0, 1e-3, &what);
        assert_share(after.velocity.x, along * kept, 1e-3, &what);
        assert_close(after.position.x, start.x + along * kept * SUBSTEP_SECONDS, 1e-3, &what);
        assert_close(after.position.y, arena::MAX.y - 0.8, 0.01, &what);
    }
}

#[test]
fn sliding_along_a_wall_costs_friction_only() {
    for angle in [0.0, core::f32::consts::PI] {
        let speed = 30.0;
        let mass = lone_agent(Size::Small, Strength::Weak).agents[0].mass();
        let mut state = lone_state(Vec2::new(14.0, arena::MIN.y + 0.815), angle);
        // A small component of the velocity points into the wall, as when a push leans on it.
        state.bodies[0].velocity = Vec2::new(speed, -0.5);
        let mut world = World::new(&lone_agent(Size::Small, Strength::Weak), &state);
        let mut expected = speed;
        let mut position = 14.0;
        for state in world.step([Action::NoForce; 2]) {
            expected -= 100.0 * SUBSTEP_SECONDS / mass;
            position += expected * SUBSTEP_SECONDS;
            assert_close(state.bodies[0].position.x, position, 0.01, "distance");
            assert_share(state.bodies[0].velocity.x, expected, 0.01, "speed");
        }
    }
}

#[test]
fn the_end_of_a_wall_behind_another_is_no_obstacle() {
    let mut physics = lone_agent(Size::Small, Strength::Weak);
    let corner = Vec2::new(16.0, 12.0);
    physics.walls = vec![
        Segment { a: Vec2::new(16.0, 2.0), b: Vec2::new(16.0, 22.0) },
        Segment { a: corner, b: Vec2::new(8.5, 12.0) },
    ];
    // The agent's right flank lies on the vertical wall, at whose other side the horizontal wall ends.
    let lean = (0.5_f32).atan();
    let flank = 2.0 * 0.8 / 5.0_f32.sqrt();
    for direction in [-1.0, 1.0] {
        let start = corner + Vec2::new(flank + 0.016, -1.5 * direction);
        let mut state = lone_state(start, lean);
        state.bodies[0].velocity = Vec2::new(0.0, 40.0 * direction);
        let after = World::new(&physics, &state).step([Action::NoForce; 2])[4].bodies[0];
        let lost = 100.0 * SUBSTEP_SECONDS / physics.agents[0].mass();
        let moved = (5.0 * 40.0 - 15.0 * lost) * SUBSTEP_SECONDS;
        assert_share((after.position.y - start.y) * direction, moved, 0.01, "distance");
    }
}

#[test]
fn corners_do_not_turn_into_walls() {
    for size in Size::ALL {
        for turn in [Action::TurnLeft, Action::TurnRight] {
            let physics = lone_agent(size, Strength::Fair);
            let start = Vec2::new(14.0, arena::MIN.y + size.radius() + 0.1);
            let mut world = World::new(&physics, &lone_state(start, 0.0));
            for _ in 0..4 {
                for state in world.step([turn, Action::NoForce]) {
                    let body = state.bodies[0];
                    for corner in geometry::trapezoid(size.radius()) {
                        let corner = body.position + Vec2::from_angle(body.angle).rotate(corner);
                        assert!(corner.y > arena::MIN.y - 0.01, "{size:?} {turn:?}: {corner}");
                    }
                }
            }
        }
    }
}

#[test]
fn what_pushes_from_behind_goes_on_while_the_front_stops() {
    let physics = physics([(Size::Small, Strength::Mighty), (Size::Small, Strength::Weak)], [Size::Small; 2]);
    let mut state = lone_state(Vec2::new(14.0, arena::MAX.y - 0.8 - 0.2 - 1.6), 0.0);
    state.bodies[2].position = Vec2::new(14.0, arena::MAX.y - 0.8 - 0.2);
    state.bodies[0].velocity.y = 24.0;
    state.bodies[2].velocity.y = 24.0;
    let mut world = World::new(&physics, &state);
    let states = world.step([Action::NoForce; 2]);
    assert_close(
        states[0].bodies[2].velocity.y,
        0.0,
        1e-3,
        "the object's speed in the substep of its impact",
    );
    assert!(states[0].bodies[0].velocity.y > 20.0, "the agent does not know of it yet");
    assert!(states[1].bodies[0].velocity.y < 12.0, "but meets the object in the next");
    let apart = |state: &State| state.bodies[2].position.y - state.bodies[0].position.y;
    assert!(apart(&states[4]) > 1.58, "and is pushed back ({})", apart(&states[4]));
    assert!(apart(&step(&mut world, Action::NoForce)) > 1.58);
}
