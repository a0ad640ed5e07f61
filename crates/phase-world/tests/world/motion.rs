//! Pushing, sliding under friction, turning and stopping, compared with formulas.

use crate::{assert_close, assert_share, lone_agent, lone_state, step};
use phase_model::{Action, Body, Entity, Size, Strength, Vec2, physics};
use phase_world::World;

const MIDDLE: Vec2 = Vec2::new(14.0, 8.0);

fn cases() -> impl Iterator<Item = (Size, Strength)> {
    Size::ALL.into_iter().flat_map(|size| Strength::ALL.map(|strength| (size, strength)))
}

#[test]
fn pushing_forward_follows_newton_with_constant_friction() {
    for (size, strength) in cases() {
        let physics = lone_agent(size, strength);
        let mass = physics.agents[0].mass();
        let surplus = strength.max_force() - 100.0;
        for angle in [0.0, 0.7, -2.5] {
            let mut world = World::new(&physics, &lone_state(MIDDLE, angle));
            let state = step(&mut world, Action::Up);
            let body = state.bodies[0];
            let what = format!("{size:?} {strength:?} at {angle}");
            let forward = body.forward();
            assert_share(body.velocity.dot(forward), 5.0 * surplus / (60.0 * mass), 0.01, &what);
            let moved = body.position - MIDDLE;
            assert_share(moved.dot(forward), 15.0 * surplus / (3600.0 * mass), 0.01, &what);
            assert_close(moved.perp_dot(forward), 0.0, 1e-3, &what);
            assert_close(body.angle, angle, 1e-3, &what);
        }
    }
}

#[test]
fn pushing_on_grows_with_the_square_of_time() {
    let mut world = World::new(&lone_agent(Size::Small, Strength::Strong), &lone_state(MIDDLE, 0.0));
    let acceleration = 350.0 / 2.56;
    for steps in 1..=4 {
        let moved = step(&mut world, Action::Up).bodies[0].position.y - MIDDLE.y;
        let substeps = 5.0 * steps as f32;
        assert_share(moved, acceleration * substeps * (substeps + 1.0) / 7200.0, 0.01, "distance");
    }
}

#[test]
fn every_direction_pushes_its_way() {
    let surplus = 15.0 * (300.0 - 100.0) / (3600.0 * 2.56);
    for action in Action::ALL {
        let Some(push) = action.push() else { continue };
        let mut world = World::new(&lone_agent(Size::Small, Strength::Fair), &lone_state(MIDDLE, 0.4));
        let moved = step(&mut world, action).bodies[0].position - MIDDLE;
        let local = Vec2::from_angle(-0.4).rotate(moved);
        assert_share(local.length(), surplus, 0.02, action.name());
        assert_close(local.angle_to(push), 0.0, 0.05, action.name());
    }
}

#[test]
fn pushing_sideways_turns_by_the_levers_of_push_and_friction() {
    for (size, strength) in cases() {
        let physics = lone_agent(size, strength);
        let agent = physics.agents[0];
        // The push to the right acts R/12 ahead of the centre of mass, friction against it R/6 ahead.
        let torque = 100.0 * agent.radius / 6.0 - agent.max_force * agent.radius / 12.0;
        let mut world = World::new(&physics, &lone_state(MIDDLE, 0.0));
        let angle = step(&mut world, Action::Right).bodies[0].angle;
        assert_close(
            angle,
            15.0 * torque / (3600.0 * agent.inertia()),
            1e-3,
            &format!("{size:?} {strength:?}"),
        );
    }
}

/// Distance covered from a speed under a constant deceleration, in substeps.
fn coasting_distance(speed: f32, deceleration: f32) -> f32 {
    let mut speed = speed;
    let mut distance = 0.0;
    while speed > 0.0 {
        speed = (speed - deceleration / 60.0).max(0.0);
        distance += speed / 60.0;
    }
    distance
}

#[test]
fn everything_coasts_to_a_stop_against_a_hundred_newtons() {
    for size in Size::ALL {
        for (index, mass) in
            [(0, lone_agent(size, Strength::Weak).agents[0].mass()), (2, physics::object_mass(size.radius()))]
        {
            let mut physics = lone_agent(size, Strength::Weak);
            physics.object_radii[0] = size.radius();
            let mut state = lone_state(MIDDLE, 0.0);
            state.bodies.swap(0, index);
            state.bodies[index].velocity = Vec2::new(0.0, 8.0);
            let mut world = World::new(&physics, &state);
            let mut last = state;
            for _ in 0..20 {
                last = step(&mut world, Action::NoForce);
            }
            let what = format!("{size:?} {:?}", Entity::ALL[index]);
            let moved = last.bodies[index].position - MIDDLE;
            assert_share(moved.y, coasting_distance(8.0, 100.0 / mass), 0.01, &what);
            assert_close(moved.x, 0.0, 1e-3, &what);
            assert_close(last.bodies[index].velocity.length(), 0.0, 1e-4, &what);
        }
    }
}

#[test]
fn turning_from_rest_and_on() {
    // Rotation in the first step from rest and in each later step (rad): 15 and 25 parts of the rotation due
    // to a torque of 300 (R/0.8)², minus the effect of the circling centre of mass and of friction at the
    // origin.
    for (size, first, steady) in [
        (Size::Small, 1.0172, 1.0639),
        (Size::Large, 0.4557, 0.4739),
        (Size::Huge, 0.2582, 0.2662),
        (Size::Medium, 0.6398, 0.6691),
    ] {
        for strength in [Strength::Weak, Strength::Mighty] {
            let mut world = World::new(&lone_agent(size, strength), &lone_state(MIDDLE, 0.3));
            let mut angle = 0.3;
            let turns = [(); 8].map(|()| {
                let body = step(&mut world, Action::TurnLeft).bodies[0];
                assert_eq!(body.angular_velocity, 0.0, "no spin is left after a step");
                let turn = body.angle - angle;
                angle = body.angle;
                turn
            });
            assert_share(turns[0], first, 0.01, &format!("first turn of {size:?}"));
            assert_share(turns[7], steady, 0.01, &format!("later turns of {size:?}"));
        }
    }
}

#[test]
fn angles_are_not_wrapped() {
    let mut world = World::new(&lone_agent(Size::Small, Strength::Weak), &lone_state(MIDDLE, 0.0));
    let last = [(); 12].map(|()| step(&mut world, Action::TurnLeft).bodies[0].angle)[11];
    assert_share(last, 1.0172 + 11.0 * 1.0639, 0.01, "angle after two turns and a half");
}

#[test]
fn turning_right_mirrors_turning_left() {
    for size in Size::ALL {
        let run = |actions: &[Action], angle: f32| -> Body {
            let mut world = World::new(&lone_agent(size, Strength::Fair), &lone_state(MIDDLE, angle));
            actions.iter().fold(Body::default(), |_, &action| step(&mut world, action).bodies[0])
        };
        let left = run(&[Action::TurnLeft, Action::Up, Action::TurnLeft, Action::UpRight], 0.2);
        let right = run(&[Action::TurnRight, Action::Up, Action::TurnRight, Action::UpLeft], -0.2);
        assert!(left.angle > 0.2, "turning left is counter-clockwise");
        assert_close(right.angle, -left.angle, 1e-4, "angle");
        assert_close(right.position.x - MIDDLE.x, MIDDLE.x - left.position.x, 1e-4, "x");
        assert_close(right.position.y, left.position.y, 1e-4, "y");
    }
}

#[test]
fn stop_takes_all_velocity_at_once() {
    let mut state = lone_state(MIDDLE, 0.5);
    state.bodies[0].velocity = Vec2::new(9.0, -40.0);
    let mut world = World::new(&lone_agent(Size::Medium, Strength::Fair), &state);
    let stopped = world.step([Action::Stop, Action::NoForce]);
    for state in stopped {
        assert_close(state.bodies[0].velocity.length(), 0.0, 1e-4, "speed");
        assert_close(state.bodies[0].position.distance(MIDDLE), 0.0, 1e-4, "distance");
    }
}

#[test]
fn nothing_moves_unless_pushed() {
    let start = lone_state(MIDDLE, 0.5);
    let mut world = World::new(&lone_agent(Size::Huge, Strength::Fair), &start);
    let settled = world.settle();
    let after = step(&mut world, Action::NoForce);
    for k in 0..4 {
        assert_eq!(settled.bodies[k].position, start.bodies[k].position);
        assert_close(after.bodies[k].position.distance(start.bodies[k].position), 0.0, 1e-5, "position");
        assert_close(after.bodies[k].angle, start.bodies[k].angle, 1e-5, "angle");
    }
}

#[test]
fn actions_last_for_one_step_only() {
    let mut world = World::new(&lone_agent(Size::Small, Strength::Mighty), &lone_state(MIDDLE, 0.0));
    let pushed = step(&mut world, Action::Up).bodies[0].velocity.y;
    let coasting = step(&mut world, Action::NoForce).bodies[0].velocity.y;
    assert_share(pushed - coasting, 5.0 * 100.0 / (60.0 * 2.56), 0.01, "speed lost to friction");
}
