//! Motion of single bodies, compared with formulas worked out by hand.

use phase_forward::Forward;
use phase_model::{
    Action, AgentBody, Body, Dynamics, PhysicsConfig, Size, State, Strength, Vec2, arena,
    physics::object_mass,
};

const MIDDLE: Vec2 = Vec2::new(14.0, 8.0);

/// An agent without company: the other rests far away.
fn lone_agent(size: Size, strength: Strength) -> PhysicsConfig {
    let agent = AgentBody { radius: size.radius(), max_force: strength.max_force() };
    PhysicsConfig { walls: Vec::new(), agents: [agent; 2], object_radii: [size.radius(); 2], object_count: 1 }
}

/// The first agent in the middle, all else in corners.
fn lone_state(angle: f32) -> State {
    let mut state = State::new(
        [[14.0, 8.0], [24.0, 20.0], [8.0, 20.0], [8.0, 4.0]]
            .map(|[x, y]| Body::at_rest(Vec2::new(x, y), 0.0)),
    );
    state.bodies[0].angle = angle;
    state
}

/// The states after some steps of the first agent, from states alone and with a cache.
fn exact(physics: &PhysicsConfig, start: &State, actions: &[Action]) -> [State; 2] {
    let forward = Forward::new(physics);
    let mut cold = *start;
    let mut warm = *start;
    let mut cache = forward.fresh_cache(start);
    for &action in actions {
        forward.step(&mut cold, [action, Action::NoForce]);
        forward.step_warm(&mut warm, &mut cache, [action, Action::NoForce]);
    }
    [cold, warm]
}

/// The states after a step of every kind.
fn all(physics: &PhysicsConfig, start: &State, action: Action) -> [State; 3] {
    let [cold, warm] = exact(physics, start, &[action]);
    let mut coarse = *start;
    Forward::new(physics).step_coarse(&mut coarse, [action, Action::NoForce]);
    [cold, warm, coarse]
}

fn cases() -> impl Iterator<Item = (Size, Strength)> {
    Size::ALL.into_iter().flat_map(|size| Strength::ALL.map(|strength| (size, strength)))
}

#[track_caller]
fn assert_near(found: f32, expected: f32, share: f32, what: &str) {
    let most = (share * expected.abs()).max(1e-3);
    assert!((found - expected).abs() <= most, "{what}: {found}, by hand {expected}");
}

#[test]
fn pushing_forward_follows_newton_with_constant_friction() {
    for (size, strength) in cases() {
        let physics = lone_agent(size, strength);
        let acceleration = (strength.max_force() - 100.0) / physics.agents[0].mass();
        for angle in [0.0, 0.7, -2.5] {
            for after in all(&physics, &lone_state(angle), Action::Up) {
                let body = after.bodies[0];
                let forward = body.forward();
                let moved = body.position - MIDDLE;
                let what = format!("{size:?} {strength:?} at {angle}");
                // Five substeps of 1/60 s, each of which moves with its final speed: 1 + 2 + 3 + 4 + 5 = 15
                // parts.
                assert_near(body.velocity.dot(forward), acceleration * 5.0 / 60.0, 0.01, &what);
                assert_near(moved.dot(forward), acceleration * 15.0 / 3600.0, 0.01, &what);
                assert_near(moved.perp_dot(forward), 0.0, 0.0, &what);
                assert_near(body.angle, angle, 0.0, &what);
            }
        }
    }
}

#[test]
fn pushing_on_grows_with_the_square_of_time() {
    let physics = lone_agent(Size::Small, Strength::Strong);
    let acceleration = (Strength::Strong.max_force() - 100.0) / physics.agents[0].mass();
    for steps in 1..=4 {
        for after in exact(&physics, &lone_state(0.0), &vec![Action::Up; steps]) {
            let substeps = 5.0 * steps as f32;
            let expected = acceleration * substeps * (substeps + 1.0) / 7200.0;
            assert_near(after.bodies[0].position.y - MIDDLE.y, expected, 0.01, "distance");
        }
    }
}

#[test]
fn every_direction_pushes_its_way() {
    let physics = lone_agent(Size::Small, Strength::Fair);
    let expected = (Strength::Fair.max_force() - 100.0) / physics.agents[0].mass() * 15.0 / 3600.0;
    for action in Action::ALL {
        let Some(push) = action.push() else { continue };
        for after in exact(&physics, &lone_state(0.4), &[action]) {
            let local = Vec2::from_angle(-0.4).rotate(after.bodies[0].position - MIDDLE);
            assert_near(local.length(), expected, 0.02, action.name());
            assert!(local.angle_to(push).abs() < 0.05, "{}: {local}", action.name());
        }
    }
}

#[test]
fn pushing_sideways_turns_by_the_levers_of_push_and_friction() {
    for (size, strength) in cases() {
        let physics = lone_agent(size, strength);
        let agent = physics.agents[0];
        // The push to the right acts R/12 ahead of the centre of mass, friction against it R/6 ahead.
        let torque = 100.0 * agent.radius / 6.0 - agent.max_force * agent.radius / 12.0;
        for after in exact(&physics, &lone_state(0.0), &[Action::Right]) {
            let expected = torque / agent.inertia() * 15.0 / 3600.0;
            assert!((after.bodies[0].angle - expected).abs() < 1e-3, "{size:?} {strength:?}: {expected}");
        }
    }
}

#[test]
fn everything_coasts_to_a_stop_against_a_hundred_newtons() {
    for size in Size::ALL {
        let physics = lone_agent(size, Strength::Weak);
        for (index, mass) in [(0, physics.agents[0].mass()), (2, object_mass(size.radius()))] {
            let mut start = lone_state(0.0);
            start.bodies[index].position = MIDDLE;
            start.bodies[2 - index].position = Vec2::new(8.0, 20.0);
            start.bodies[index].velocity = Vec2::new(0.0, 8.0);
            let mut speed: f32 = 8.0;
            let mut distance = 0.0;
            while speed > 0.0 {
                speed = (speed - 100.0 / mass / 60.0).max(0.0);
                distance += speed / 60.0;
            }
            for last in exact(&physics, &start, &[Action::NoForce; 20]) {
                let body = last.bodies[index];
                assert_near(body.position.y - MIDDLE.y, distance, 0.01, &format!("{size:?}, body {index}"));
                assert_near(body.position.x, MIDDLE.x, 0.0, "sideways");
                assert_eq!(body.velocity, Vec2::ZERO);
            }
        }
    }
}

#[test]
fn turning_right_mirrors_turning_left() {
    for size in Size::ALL {
        let physics = lone_agent(size, Strength::Fair);
        let run = |actions: &[Action], angle: f32| exact(&physics, &lone_state(angle), actions);
        let left = run(&[Action::TurnLeft, Action::Up, Action::TurnLeft, Action::UpRight], 0.2);
        let right = run(&[Action::TurnRight, Action::Up, Action::TurnRight, Action::UpLeft], -0.2);
        for (left, right) in left.into_iter().zip(right) {
            let [left, right] = [left.bodies[0], right.bodies[0]];
            assert!(left.angle > 0.2, "turning left is counter-clockwise");
            assert_near(right.angle, -left.angle, 0.0, "angle");
            assert_near(right.position.x - MIDDLE.x, MIDDLE.x - left.position.x, 0.0, "x");
            assert_near(right.position.y, left.position.y, 0.0, "y");
        }
    }
}

#[test]
fn stop_takes_all_velocity_at_once() {
    let mut start = lone_state(0.5);
    start.bodies[0].velocity = Vec2::new(9.0, -40.0);
    for after in all(&lone_agent(Size::Medium, Strength::Fair), &start, Action::Stop) {
        assert!(after.bodies[0].velocity.length() < 1e-4 && after.bodies[0].position.distance(MIDDLE) < 1e-4);
    }
}

#[test]
fn an_impact_takes_the_speed_into_the_wall_and_leaves_the_rest() {
    let physics = lone_agent(Size::Small, Strength::Weak);
    for (across, gap) in [(20.0_f32, 0.05), (30.0, 0.3), (60.0, 0.9)] {
        let along = 12.0;
        // Friction acts before the impact, against the direction of motion.
        let kept = 1.0 - 100.0 / 60.0 / object_mass(0.8) / across.hypot(along);
        let place = Vec2::new(14.0, arena::MAX.y - 0.8 - gap);
        let mut state = lone_state(0.0);
        state.bodies[2] = Body { position: place, velocity: Vec2::new(along, across), ..Body::default() };
        let after = Forward::new(&physics).step_substeps(&mut state, [Action::NoForce; 2])[0].bodies[2];
        let what = format!("at {across} u/s from {gap} u");
        assert_near(after.velocity.y, 0.0, 0.0, &what);
        assert_near(after.velocity.x, along * kept, 1e-3, &what);
        assert_near(after.position.x, place.x + along * kept / 60.0, 0.0, &what);
        assert!((after.position.y - (arena::MAX.y - 0.8)).abs() < 0.01, "{what}: {}", after.position.y);
    }
}
