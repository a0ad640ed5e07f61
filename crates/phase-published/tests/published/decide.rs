//! Action sets, rewards and decisions.

use crate::common::{BALL, ME, OTHER, ball_on, hold, mind, on_landmark, random, scene};
use phase_model::{Action, Attitude, Entity, LandmarkId, RoomId, Scene, Sign};
use phase_published::{Aim, Mind, PublishedParameters, Rooms, SearchMemo};

const BODIES: [(f32, f32, f32); 4] = [(23.5, 14.0, 0.0), (8.0, 4.0, 0.0), (8.0, 20.0, 0.0), (8.0, 10.0, 0.0)];

fn walking() -> Scene {
    let goals = [on_landmark(ME, LandmarkId::TOP_RIGHT), on_landmark(OTHER, LandmarkId::TOP_LEFT)];
    scene(4, goals, Attitude::Neutral, BODIES)
}

fn searched(scene: &Scene, mind: &mut Mind) -> (Action, Vec<(Action, u32)>) {
    let (action, thought) = mind.decide(&[scene.initial_state()], &mut random(5)).unwrap();
    (action, thought.actions.iter().map(|found| (found.action, found.visits)).collect())
}

#[test]
fn the_landmark_ahead_is_walked_to() {
    let scene = walking();
    let (action, visits) = searched(&scene, &mut mind(&scene, ME, 1000));
    assert_eq!(action, Action::Up);
    assert_eq!(visits.iter().map(|(_, visits)| visits).sum::<u32>(), 1000);
    let set = [Action::TurnLeft, Action::TurnRight, Action::Up, Action::Stop, Action::NoForce];
    assert!(visits.iter().map(|(action, _)| *action).eq(set));
}

#[test]
fn several_searches_add_up() {
    let scene = walking();
    let parameters = PublishedParameters { simulations: 40, searches: 3, ..PublishedParameters::default() };
    let (_, visits) = searched(&scene, &mut Mind::new(&scene, ME, parameters).unwrap());
    assert_eq!(visits.iter().map(|(_, visits)| visits).sum::<u32>(), 120);
}

#[test]
fn one_seed_makes_one_decision() {
    let scene = walking();
    assert_eq!(searched(&scene, &mut mind(&scene, ME, 50)), searched(&scene, &mut mind(&scene, ME, 50)));
}

#[test]
fn minds_that_share_searches_decide_as_they_would_alone() {
    // With either landmark as the goal, the ball that is not seen is looked for first, from the same random
    // numbers; from another place the same subgoal is another search.
    let memo = SearchMemo::default();
    let mut subgoals = Vec::new();
    for landmark in [LandmarkId::TOP_RIGHT, LandmarkId::BOTTOM_RIGHT] {
        let scene = scene(4, [ball_on(landmark), on_landmark(OTHER, landmark)], Attitude::Neutral, BODIES);
        let mut sharing = mind(&scene, ME, 60).sharing(memo.clone());
        for dy in [0.0, 0.0, 1.5] {
            let mut state = scene.initial_state();
            state.body_mut(Entity::Agent(ME)).position.y += dy;
            let shared = sharing.decide(&[state], &mut random(5)).unwrap();
            assert_eq!(shared, mind(&scene, ME, 60).decide(&[state], &mut random(5)).unwrap());
            subgoals.push((shared.1.subgoal, shared.1.actions));
        }
    }
    assert_eq!(subgoals[0], subgoals[3], "both goals lead to one search");
    assert_eq!(subgoals[0].0, subgoals[2].0);
    assert_ne!(subgoals[0].1, subgoals[2].1, "another state is another search");
}

#[test]
fn without_particles_or_aim_the_agent_stops() {
    let scene = walking();
    assert_eq!(mind(&scene, ME, 10).decide(&[], &mut random(1)).unwrap().0, Action::Stop);
    let mut there = scene.initial_state();
    there.body_mut(Entity::Agent(ME)).position = (23.5, 19.5).into();
    let (action, thought) = mind(&scene, ME, 10).decide(&[there], &mut random(1)).unwrap();
    assert_eq!(action, Action::Stop);
    assert!(thought.actions.is_empty());
}

#[test]
fn action_sets_follow_the_subgoal() {
    let scene = walking();
    let free = scene.initial_state();
    let mut holding = free;
    hold(&mut holding, ME);
    let count = |aim: Aim, state| aim.actions(ME, false, state).len();
    let positive = Sign::Positive;
    let landmark = LandmarkId::TOP_LEFT;
    assert_eq!(count(Aim::AgentToLandmark(ME, landmark, positive), &free), 5);
    assert_eq!(count(Aim::AgentToLandmark(OTHER, landmark, Sign::Negative), &free), 12);
    assert_eq!(count(Aim::AgentToRoom(ME, RoomId::TOP_LEFT, Sign::Positive), &free), 5);
    assert_eq!(count(Aim::Touch(ME, Entity::Agent(OTHER), positive), &free), 5);
    assert_eq!(count(Aim::ObjectToLandmark(BALL, landmark, positive), &holding), 13);
    assert_eq!(count(Aim::Grab(ME, BALL, positive), &free), 13);
    assert_eq!(count(Aim::Grab(ME, BALL, Sign::Negative), &holding), 14);
    assert_eq!(count(Aim::ObjectToRoom(BALL, RoomId::TOP_RIGHT), &holding), 12);
    assert_eq!(count(Aim::ObjectToRoom(BALL, RoomId::TOP_LEFT), &free), 13);
    assert_eq!(count(Aim::Stop, &free), 1);
}

/// r = −sign · d / 28.284 less 0.02 for a push that is not forward; an object in its room earns ten more.
#[test]
fn rewards_are_distances() {
    let scene = walking();
    let rooms = Rooms::new(scene.layout);
    let state = scene.initial_state();
    let reach = Aim::AgentToLandmark(ME, LandmarkId::TOP_RIGHT, Sign::Positive);
    assert!((reach.reward(&rooms, &state, Action::Up) + 5.5 / 28.284_27).abs() < 1e-6);
    assert!((reach.reward(&rooms, &state, Action::Left) + 5.5 / 28.284_27 + 0.02).abs() < 1e-6);
    let avoid = Aim::AgentToLandmark(ME, LandmarkId::TOP_RIGHT, Sign::Negative);
    assert!((avoid.reward(&rooms, &state, Action::Up) - 5.5 / 28.284_27).abs() < 1e-6);
    // The object at (8, 20) lies 1.0607 u from its room's corner (7.25, 20.75).
    let there = Aim::ObjectToRoom(BALL, RoomId::TOP_LEFT).reward(&rooms, &state, Action::Up);
    assert!((there - (10.0 - 1.060_66 / 28.284_27)).abs() < 1e-4, "{there}");
}

/// In the older set an agent on the way to a landmark may push in all directions.
#[test]
fn the_older_actions_push_sideways() {
    let reach = Aim::AgentToLandmark(ME, LandmarkId::TOP_LEFT, Sign::Positive);
    assert_eq!(reach.actions(ME, true, &walking().initial_state()).len(), 12);
    let enter = Aim::AgentToRoom(ME, RoomId::TOP_LEFT, Sign::Positive);
    assert_eq!(enter.actions(ME, true, &walking().initial_state()).len(), 5);
}

#[test]
fn a_held_object_is_carried_towards_its_landmark() {
    let goals = [ball_on(LandmarkId::TOP_RIGHT), on_landmark(OTHER, LandmarkId::TOP_LEFT)];
    let scene = scene(0, goals, Attitude::Neutral, BODIES);
    let mut state = scene.initial_state();
    state.body_mut(Entity::Agent(ME)).position = (23.5, 10.0).into();
    hold(&mut state, ME);
    let (action, thought) = mind(&scene, ME, 1000).decide(&[state], &mut random(2)).unwrap();
    assert_eq!(thought.subgoal, Aim::ObjectToLandmark(BALL, LandmarkId::TOP_RIGHT, Sign::Positive).subgoal());
    assert!([Action::Up, Action::UpLeft, Action::UpRight].contains(&action), "{action:?}");
}
