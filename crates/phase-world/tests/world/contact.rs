//! The contacts that states report.

use crate::{ASIDE, OBJECT, lone_agent, step};
use phase_model::{Action, AgentId, Body, Contacts, Entity, Size, State, Strength, Vec2};
use phase_world::World;

/// Agent 0 with object 0 straight ahead at a gap.
fn ahead(gap: f32) -> State {
    State::new([
        Body::at_rest(Vec2::new(12.0, 8.0), 0.0),
        Body::at_rest(ASIDE, 0.0),
        Body::at_rest(Vec2::new(12.0, 9.6 + gap), 0.0),
        Body::at_rest(ASIDE - Vec2::new(0.0, 5.0), 0.0),
    ])
}

#[test]
fn only_bodies_within_a_fiftieth_touch() {
    for (gap, expected) in [(-0.2, true), (0.0, true), (0.015, true), (0.03, false), (0.5, false)] {
        let world = World::new(&lone_agent(Size::Small, Strength::Fair), &ahead(gap));
        let contacts = world.state().contacts;
        assert_eq!(contacts.touching(Entity::Agent(AgentId::ZERO), OBJECT), expected, "gap {gap}");
        let mut only = Contacts::NONE;
        if expected {
            only.insert(OBJECT, Entity::Agent(AgentId::ZERO));
        }
        assert_eq!(contacts, only, "no other pair touches");
    }
}

#[test]
fn pushing_touches_until_the_pusher_stops() {
    let mut world = World::new(&lone_agent(Size::Small, Strength::Strong), &ahead(0.1));
    assert!(!world.state().touching(Entity::Agent(AgentId::ZERO), OBJECT));
    for _ in 0..3 {
        step(&mut world, Action::Up);
    }
    assert!(step(&mut world, Action::Up).touching(Entity::Agent(AgentId::ZERO), OBJECT));
    assert!(
        !step(&mut world, Action::Stop).touching(Entity::Agent(AgentId::ZERO), OBJECT),
        "the object rolls on"
    );
}

#[test]
fn held_pairs_touch_through_their_grip() {
    let mut world = World::new(&lone_agent(Size::Small, Strength::Strong), &ahead(0.1));
    let state = step(&mut world, Action::Attach);
    assert_eq!(state.contacts, Contacts::NONE);
    assert!(state.touching(Entity::Agent(AgentId::ZERO), OBJECT));
    let state = step(&mut world, Action::Detach);
    assert!(state.contacts.touching(Entity::Agent(AgentId::ZERO), OBJECT), "let go, but still in contact");
}

#[test]
fn walls_are_no_contacts() {
    let mut state = ahead(3.0);
    state.bodies[0].position = Vec2::new(12.0, 3.0);
    let mut world = World::new(&lone_agent(Size::Small, Strength::Strong), &state);
    for _ in 0..4 {
        state = step(&mut world, Action::Down);
    }
    assert!(state.bodies[0].position.y < 2.83, "the agent stands against the wall");
    assert_eq!(state.contacts, Contacts::NONE);
}

#[test]
fn bodies_do_not_pass_through_each_other() {
    let mut world = World::new(&lone_agent(Size::Small, Strength::Mighty), &ahead(0.3));
    // Five steps end before the wall, where the agent would otherwise run into the stopped object for a
    // substep.
    for _ in 0..5 {
        let state = step(&mut world, Action::Up);
        assert!(state.position(OBJECT).y - state.bodies[0].position.y > 1.55);
    }
}

#[test]
fn what_was_let_go_is_solid_once_either_has_left_its_place() {
    let mut world = World::new(&lone_agent(Size::Small, Strength::Mighty), &ahead(0.0));
    step(&mut world, Action::Attach);
    let released = step(&mut world, Action::Detach).position(OBJECT);
    let mut least = f32::INFINITY;
    let mut last = world.state();
    for _ in 0..4 {
        for state in world.step([Action::Up, Action::NoForce]) {
            least = least.min(state.position(OBJECT).distance(state.bodies[0].position));
            last = state;
        }
    }
    // The agent penetrates the object by 0.1 u and one substep's path, 0.2 u at most from rest; then it
    // pushes it.
    assert!((1.3..1.55).contains(&least), "nearest {least}");
    assert!(last.position(OBJECT).distance(released) > 1.0, "the agent pushes the object ahead");
    assert!(last.position(OBJECT).distance(last.bodies[0].position) > 1.58, "and does not stay in it");
}
