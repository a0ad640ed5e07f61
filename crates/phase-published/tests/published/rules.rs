//! The neutral rules, step by step, and the selection among their subgoals.

use crate::common::{BALL, ME, OTHER, aim, ball_on, hold, mind, on_landmark, random, scene};
use phase_model::{Attitude, Entity, Goal, LandmarkId, RoomId, Sign, State, Subgoal, Vec2, arena};
use phase_published::Aim;

const TL: LandmarkId = LandmarkId::TOP_LEFT;
const TR: LandmarkId = LandmarkId::TOP_RIGHT;

/// Layout 4: rooms 0, 3, 2, 1 in a chain, with a door of 2.5 u between 0 and 3.
fn walled(goal: Goal, bodies: [(f32, f32, f32); 4]) -> (phase_model::Scene, State) {
    let scene = scene(4, [goal, on_landmark(OTHER, TL)], Attitude::Neutral, bodies);
    let state = scene.initial_state();
    (scene, state)
}

const BODIES: [(f32, f32, f32); 4] = [(8.0, 20.0, 0.0), (24.0, 4.0, 0.0), (24.0, 10.0, 0.0), (8.0, 4.0, 0.0)];

fn put(state: &mut State, entity: Entity, place: Vec2) {
    state.body_mut(entity).position = place;
}

#[test]
fn an_agent_goes_room_by_room_and_stops_within_the_threshold() {
    let (scene, mut state) = walled(on_landmark(ME, TR), BODIES);
    let me = Entity::Agent(ME);
    for (place, room) in [((8.0, 20.0), 3), ((8.0, 4.0), 2), ((24.0, 4.0), 1)] {
        put(&mut state, me, place.into());
        assert_eq!(aim(&scene, ME, &state), Aim::AgentToRoom(ME, RoomId::ALL[room], Sign::Positive));
    }
    put(&mut state, me, arena::LANDMARKS[TR] + Vec2::new(0.57, 0.0));
    assert_eq!(aim(&scene, ME, &state), Aim::AgentToLandmark(ME, TR, Sign::Positive));
    put(&mut state, me, arena::LANDMARKS[TR] + Vec2::new(0.56, 0.0));
    assert_eq!(aim(&scene, ME, &state), Aim::Stop);
    hold(&mut state, ME);
    assert_eq!(aim(&scene, ME, &state), Aim::Grab(ME, BALL, Sign::Negative));
}

#[test]
fn an_object_is_approached_grabbed_dragged_and_released() {
    let (scene, mut state) = walled(ball_on(LandmarkId::BOTTOM_LEFT), BODIES);
    let me = Entity::Agent(ME);
    let ball = Entity::Object(BALL);
    assert_eq!(aim(&scene, ME, &state), Aim::AgentToRoom(ME, RoomId::BOTTOM_LEFT, Sign::Positive));
    put(&mut state, me, Vec2::new(20.0, 10.0));
    assert_eq!(aim(&scene, ME, &state), Aim::Touch(ME, ball, Sign::Positive));
    // Within r + 0.5 u of a grab point, which lies R from the origin.
    put(&mut state, me, Vec2::new(24.0 - 2.05, 10.0));
    assert_eq!(aim(&scene, ME, &state), Aim::Grab(ME, BALL, Sign::Positive));
    hold(&mut state, ME);
    assert_eq!(aim(&scene, ME, &state), Aim::ObjectToRoom(BALL, RoomId::BOTTOM_LEFT));
    put(&mut state, me, Vec2::new(12.0, 8.0));
    hold(&mut state, ME);
    assert_eq!(aim(&scene, ME, &state), Aim::ObjectToLandmark(BALL, LandmarkId::BOTTOM_LEFT, Sign::Positive));
    put(&mut state, ball, arena::LANDMARKS[LandmarkId::BOTTOM_LEFT] + Vec2::new(1.41, 0.0));
    assert_eq!(aim(&scene, ME, &state), Aim::Grab(ME, BALL, Sign::Negative));
    state.grips[ME] = None;
    assert_eq!(aim(&scene, ME, &state), Aim::Stop);
}

#[test]
fn a_fleer_wants_distance_alone() {
    let chase = Goal::Touch { agent: ME, other: OTHER, sign: Sign::Positive };
    let scene = scene(4, [chase, chase.negated()], Attitude::Neutral, BODIES);
    let state = scene.initial_state();
    let flee = Aim::Touch(ME, Entity::Agent(OTHER), Sign::Negative);
    assert_eq!(aim(&scene, OTHER, &state), flee);
    assert_eq!(aim(&scene, ME, &state), Aim::AgentToRoom(ME, RoomId::BOTTOM_LEFT, Sign::Positive));
}

/// One particle that has the object in the agent's own room decides, however many have it elsewhere.
#[test]
fn going_to_an_object_beats_every_search() {
    let (scene, state) = walled(ball_on(TL), BODIES);
    let mut near = state;
    put(&mut near, Entity::Object(BALL), Vec2::new(14.0, 14.0));
    let mut particles = vec![state; 49];
    particles.push(near);
    let mut mind = mind(&scene, ME, 10);
    let (_, thought) = mind.decide(&particles, &mut random(1)).unwrap();
    assert_eq!(thought.subgoal, Aim::Touch(ME, Entity::Object(BALL), Sign::Positive).subgoal());
    assert_eq!(thought.subgoals.len(), 2);
    assert_eq!(thought.subgoals[0].particles, 49);
    assert!((thought.subgoals[0].value - (0.98 - mind.cost(&state))).abs() < 1e-12);
}

/// A share of particles less 0.05 times the distance; here the distance decides against the larger share.
#[test]
fn the_value_of_a_subgoal_counts_the_distance() {
    let (scene, mut state) = walled(on_landmark(ME, TL), BODIES);
    put(&mut state, Entity::Agent(ME), Vec2::new(8.5, 14.5));
    let (_, thought) = mind(&scene, ME, 10).decide(&[state], &mut random(1)).unwrap();
    assert!((thought.subgoals[0].value - (1.0 - 0.05 * 5.0)).abs() < 1e-6);
    assert!(matches!(thought.subgoal, Subgoal::Achieve(_)));
}
