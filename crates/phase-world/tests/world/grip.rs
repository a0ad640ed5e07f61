//! Grabbing, carrying and releasing.

use crate::{ASIDE, OBJECT, assert_close, assert_share, lone_agent, physics, step};
use phase_model::{
    Action, AgentId, Body, Grip, ObjectId, PhysicsConfig, Side, Size, State, Strength, Vec2,
    physics::object_mass,
};
use phase_world::World;

const AGENT: Vec2 = Vec2::new(12.0, 8.0);
const ANGLE: f32 = 0.6;

/// Agent 0 with object 0 at one of its sides, leaving a gap between the side's grab point and the object.
fn beside(physics: &PhysicsConfig, side: Side, gap: f32) -> State {
    let distance = physics.agents[0].radius + physics.object_radii[0] + gap;
    let offset = Vec2::from_angle(ANGLE).rotate(side.direction()) * distance;
    let mut bodies = [Body::at_rest(ASIDE, 0.0); 4];
    bodies[0] = Body::at_rest(AGENT, ANGLE);
    bodies[2] = Body::at_rest(AGENT + offset, 0.1);
    bodies[3].position -= Vec2::new(0.0, 5.0);
    State::new(bodies)
}

/// Agent 0 below an object, agent 1 above it and facing it.
fn around(physics: &PhysicsConfig) -> State {
    let middle = Vec2::new(12.0, 10.0);
    let time_of_impact =
        |agent: usize| Vec2::new(0.0, physics.agents[agent].radius + physics.object_radii[0] + 0.02);
    State::new([
        Body::at_rest(middle - time_of_impact(0), 0.0),
        Body::at_rest(middle + time_of_impact(1), core::f32::consts::PI),
        Body::at_rest(middle, 0.0),
        Body::at_rest(ASIDE, 0.0),
    ])
}

#[test]
fn grabbing_reaches_half_a_unit_from_every_side() {
    for side in Side::ALL {
        for (gap, expected) in [(0.05, true), (0.49, true), (0.51, false), (1.0, false)] {
            let physics = lone_agent(Size::Large, Strength::Fair);
            let mut world = World::new(&physics, &beside(&physics, side, gap));
            let grip = step(&mut world, Action::Attach).grips[0];
            assert_eq!(
                grip.map(|grip| (grip.object, grip.side)),
                expected.then_some((ObjectId::ZERO, side)),
                "{gap}"
            );
        }
    }
}

#[test]
fn a_held_object_snaps_to_the_side_and_keeps_its_relative_angle() {
    for size in Size::ALL {
        for object in Size::ALL {
            for side in Side::ALL {
                let mut physics = lone_agent(size, Strength::Fair);
                physics.object_radii[0] = object.radius();
                let mut world = World::new(&physics, &beside(&physics, side, 0.3));
                let what = format!("{size:?} {object:?} {side:?}");
                for action in [Action::Attach, Action::TurnLeft, Action::Up, Action::Down] {
                    let state = step(&mut world, action);
                    let agent = state.bodies[0];
                    let offset = Vec2::from_angle(agent.angle)
                        .rotate(side.direction() * (size.radius() + object.radius()));
                    let distance = state.position(OBJECT).distance(agent.position + offset);
                    assert_close(distance, 0.0, 1e-2, &what);
                    assert_close(state.body(OBJECT).angle - agent.angle, 0.1 - ANGLE, 1e-2, &what);
                }
            }
        }
    }
}

#[test]
fn the_weakest_carries_and_pushes_nothing() {
    for size in Size::ALL {
        for object in Size::ALL {
            let mut physics = lone_agent(size, Strength::Weak);
            physics.object_radii[0] = object.radius();
            for first in [Action::Attach, Action::NoForce] {
                let mut world = World::new(&physics, &beside(&physics, Side::Head, 0.0));
                let before = step(&mut world, first).position(OBJECT);
                let after = [(); 6].map(|()| step(&mut world, Action::Up).position(OBJECT))[5];
                assert_close(after.distance(before), 0.0, 1e-2, &format!("{size:?} {object:?} {first:?}"));
            }
        }
    }
}

#[test]
fn carrying_costs_a_hundred_newtons_for_each_body() {
    for size in Size::ALL {
        for object in Size::ALL {
            for strength in [Strength::Fair, Strength::Strong, Strength::Mighty] {
                let mut physics = lone_agent(size, strength);
                physics.object_radii[0] = object.radius();
                let mut world = World::new(&physics, &beside(&physics, Side::Head, 0.0));
                let before = step(&mut world, Action::Attach).position(OBJECT);
                let state = step(&mut world, Action::Up);
                let mass = physics.agents[0].mass() + object_mass(object.radius());
                let expected = (strength.max_force() - 200.0) * 15.0 / (3600.0 * mass);
                let moved = (state.position(OBJECT) - before).dot(state.bodies[0].forward());
                assert_share(moved, expected, 0.02, &format!("{size:?} {object:?} {strength:?}"));
            }
        }
    }
}

#[test]
fn two_agents_add_their_forces() {
    for object in Size::ALL {
        for (first, second) in [
            (Strength::Weak, Strength::Weak),
            (Strength::Weak, Strength::Fair),
            (Strength::Mighty, Strength::Mighty),
        ] {
            let physics = physics([(Size::Small, first), (Size::Small, second)], [object, Size::Small]);
            let mut world = World::new(&physics, &around(&physics));
            let held = world.step([Action::Attach; 2])[4];
            assert_eq!(
                [held.held_object(AgentId::ZERO), held.held_object(AgentId::ONE)],
                [Some(ObjectId::ZERO); 2]
            );
            let carried = world.step([Action::Up, Action::Down])[4];
            let mass = 2.0 * 2.56 + object_mass(object.radius());
            let surplus = (first.max_force() + second.max_force() - 300.0).max(0.0);
            let moved = carried.position(OBJECT).y - held.position(OBJECT).y;
            assert_close(
                moved,
                surplus * 15.0 / (3600.0 * mass),
                4e-3,
                &format!("{object:?} {first:?} {second:?}"),
            );
        }
    }
}

#[test]
fn the_stronger_wins_a_tug_of_war() {
    let physics =
        physics([(Size::Small, Strength::Weak), (Size::Small, Strength::Mighty)], [Size::Small, Size::Small]);
    let mut world = World::new(&physics, &around(&physics));
    let before = world.step([Action::Attach; 2])[4].position(OBJECT);
    let after = [(); 4].map(|()| world.step([Action::Down; 2])[4].position(OBJECT))[3];
    // 600 N against 150 N and the friction of three bodies.
    let expected = 150.0 * 210.0 / (3600.0 * (2.0 * 2.56 + object_mass(0.8)));
    assert_share(after.y - before.y, expected, 0.02, "distance");
}

#[test]
fn letting_go_changes_nothing_else() {
    for side in Side::ALL {
        let physics = lone_agent(Size::Huge, Strength::Mighty);
        let mut world = World::new(&physics, &beside(&physics, side, 0.0));
        step(&mut world, Action::Attach);
        let away = match side {
            Side::Head => Action::Down,
            Side::Tail => Action::Up,
            Side::Right => Action::Left,
            Side::Left => Action::Right,
        };
        step(&mut world, away);
        let held = step(&mut world, away);
        let mut fastest = held.bodies[0].velocity.length();
        for action in [Action::Detach, Action::NoForce, Action::NoForce] {
            let state = step(&mut world, action);
            assert_eq!(state.grips, [None; 2]);
            for k in [0, 2] {
                assert!(
                    state.bodies[k].velocity.length() <= fastest + 1e-3,
                    "{side:?}: nothing is thrown off"
                );
            }
            fastest = fastest.max(1e-3);
        }
    }
}

#[test]
fn an_object_let_go_becomes_solid_once_clear() {
    let physics = lone_agent(Size::Small, Strength::Mighty);
    let mut world = World::new(&physics, &beside(&physics, Side::Head, 0.0));
    for action in [Action::Attach, Action::Detach, Action::Down, Action::Stop] {
        step(&mut world, action);
    }
    let before = step(&mut world, Action::NoForce).position(OBJECT);
    let after = [(); 4].map(|()| step(&mut world, Action::Up))[3];
    assert!(after.position(OBJECT).distance(before) > 1.0, "the agent pushes the object again");
    let distance = after.position(OBJECT).distance(after.bodies[0].position);
    assert!(distance >= 1.59, "and does not pass through it ({distance})");
}

#[test]
fn letting_go_is_each_agents_own() {
    let physics = physics([(Size::Small, Strength::Fair); 2], [Size::Small; 2]);
    let mut world = World::new(&physics, &around(&physics));
    world.step([Action::Attach; 2]);
    let state = world.step([Action::Detach, Action::Attach])[4];
    assert_eq!(
        [state.held_object(AgentId::ZERO), state.held_object(AgentId::ONE)],
        [None, Some(ObjectId::ZERO)]
    );
    let state = world.step([Action::Detach, Action::Detach])[4];
    assert_eq!(state.grips, [None; 2], "detaching without holding does nothing");
}

#[test]
fn grips_of_a_given_state_are_real() {
    let physics = lone_agent(Size::Small, Strength::Mighty);
    let mut state = beside(&physics, Side::Tail, 0.0);
    state.grips[0] = Some(Grip { object: ObjectId::ZERO, side: Side::Tail, relative_angle: 0.1 - ANGLE });
    let mut world = World::new(&physics, &state);
    assert_eq!(world.state().grips, state.grips);
    let after = [(); 3].map(|()| step(&mut world, Action::Up))[2];
    assert_eq!(after.grips, state.grips);
    assert!(after.position(OBJECT).distance(state.position(OBJECT)) > 0.5, "the object is dragged along");
    assert_close(after.position(OBJECT).distance(after.bodies[0].position), 1.6, 1e-2, "distance");

    state.grips[0] = Some(Grip { object: ObjectId::ONE, side: Side::Tail, relative_angle: 0.0 });
    let physics = PhysicsConfig { object_count: 1, ..physics };
    assert_eq!(World::new(&physics, &state).state().grips, [None; 2], "no such object");
}
