//! The friendly and the adversarial rules.

use crate::common::{BALL, ME, OTHER, aim, ball_on, hold, on_landmark, scene};
use phase_model::{Attitude, Entity, LandmarkId, RoomId, Sign, Size, State, Vec2};
use phase_published::Aim;

const BODIES: [(f32, f32, f32); 4] =
    [(8.0, 20.0, 0.0), (24.0, 4.0, 0.0), (14.0, 16.0, 0.0), (24.0, 10.0, 0.0)];

fn put(state: &mut State, entity: Entity, place: (f32, f32)) {
    state.body_mut(entity).position = Vec2::from(place);
}

#[test]
fn a_helper_that_is_blocked_nowhere_does_it_all() {
    let goal = ball_on(LandmarkId::BOTTOM_LEFT);
    let scene = scene(4, [goal, goal], Attitude::Help, BODIES);
    assert_eq!(aim(&scene, ME, &scene.initial_state()), Aim::Touch(ME, Entity::Object(BALL), Sign::Positive));
}

#[test]
fn a_helper_that_cannot_carry_it_out_leaves_it_to_the_other() {
    let goal = ball_on(LandmarkId::BOTTOM_LEFT);
    let mut scene = scene(4, [goal, goal], Attitude::Help, BODIES);
    scene.agents[0].size = Size::Large;
    // The other, small, can do all; nothing is left but the goal itself.
    let mut state = scene.initial_state();
    assert_eq!(aim(&scene, ME, &state), Aim::ObjectToLandmark(BALL, LandmarkId::BOTTOM_LEFT, Sign::Positive));
    hold(&mut state, OTHER);
    assert_eq!(aim(&scene, ME, &state), Aim::Stop);
    // The other can enter the goal's room, but not the object's: it is brought to it.
    let goal = ball_on(LandmarkId::BOTTOM_LEFT);
    let mut scene = crate::common::scene(4, [goal, goal], Attitude::Help, BODIES);
    scene.agents[1].size = Size::Large;
    scene.agents[0].size = Size::Small;
    assert!(matches!(aim(&scene, ME, &scene.initial_state()), Aim::Touch(..)));
}

#[test]
fn a_helper_clears_the_door() {
    let goal = on_landmark(OTHER, LandmarkId::TOP_LEFT);
    let scene = scene(4, [goal, goal], Attitude::Help, BODIES);
    let mut state = scene.initial_state();
    assert_eq!(aim(&scene, ME, &state), Aim::Stop);
    // The first object stands in the door (7.25, 12) on the other's way.
    put(&mut state, Entity::Object(BALL), (7.25, 13.0));
    assert_eq!(aim(&scene, ME, &state), Aim::Touch(ME, Entity::Object(BALL), Sign::Positive));
}

#[test]
fn a_hinderer_follows_into_the_room_and_pushes() {
    let goal = on_landmark(OTHER, LandmarkId::BOTTOM_RIGHT);
    let scene = scene(4, [goal.negated(), goal], Attitude::Hinder, BODIES);
    let mut state = scene.initial_state();
    // The other is in the room of its goal.
    assert_eq!(aim(&scene, ME, &state), Aim::AgentToRoom(ME, RoomId::BOTTOM_LEFT, Sign::Positive));
    put(&mut state, Entity::Agent(ME), (18.0, 8.0));
    assert_eq!(
        aim(&scene, ME, &state),
        Aim::AgentToLandmark(OTHER, LandmarkId::BOTTOM_RIGHT, Sign::Negative)
    );
    hold(&mut state, ME);
    assert_eq!(aim(&scene, ME, &state), Aim::Grab(ME, BALL, Sign::Negative));
}

#[test]
fn a_hinderer_goes_where_the_other_has_to_pass() {
    let goal = on_landmark(OTHER, LandmarkId::BOTTOM_LEFT);
    // Layout 16: half walls all around, the full one at the top.
    let scene = scene(16, [goal.negated(), goal], Attitude::Hinder, BODIES);
    let mut state = scene.initial_state();
    put(&mut state, Entity::Agent(ME), (20.0, 4.0));
    assert_eq!(aim(&scene, ME, &state), Aim::AgentToRoom(ME, RoomId::BOTTOM_LEFT, Sign::Positive));
    put(&mut state, Entity::Agent(ME), (8.0, 4.0));
    assert_eq!(aim(&scene, ME, &state), Aim::AgentToRoom(ME, RoomId::BOTTOM_RIGHT, Sign::Positive));
}

#[test]
fn a_hinderer_plugs_a_narrow_door_with_a_large_object() {
    let goal = on_landmark(OTHER, LandmarkId::TOP_LEFT);
    let mut scene = scene(4, [goal.negated(), goal], Attitude::Hinder, BODIES);
    scene.objects[0].size = Size::Huge;
    assert_eq!(aim(&scene, ME, &scene.initial_state()), Aim::Touch(ME, Entity::Object(BALL), Sign::Positive));
}
