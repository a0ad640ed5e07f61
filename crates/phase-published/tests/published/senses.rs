//! Sight, touch, and what is inferred from touch.

use crate::common::{BALL, ME, OTHER, hold, on_landmark, random, scene};
use phase_model::{Attitude, Entity, LandmarkId, Layout, ObjectId, State, Vec2};
use phase_perception::{Cell, field_of_view};
use phase_published::senses::{in_view, observe};
use rand::RngExt;

const AHEAD: f32 = 0.0;

fn state(bodies: [(f32, f32, f32); 4]) -> (phase_model::PhysicsConfig, State) {
    let goals = [on_landmark(ME, LandmarkId::TOP_LEFT), on_landmark(OTHER, LandmarkId::TOP_LEFT)];
    let scene = scene(0, goals, Attitude::Neutral, bodies);
    (scene.physics(), scene.initial_state())
}

#[test]
fn the_cone_is_seen_and_the_back_is_not() {
    let (physics, state) = state([(16.0, 9.0, AHEAD), (16.0, 15.0, 0.0), (16.0, 4.0, 0.0), (9.0, 9.0, 0.0)]);
    let observed = observe(&physics, &state, ME).observed;
    assert!(observed.contains(Entity::Agent(ME)) && observed.contains(Entity::Agent(OTHER)));
    assert!(!observed.contains(Entity::Object(BALL)) && !observed.contains(Entity::Object(ObjectId::ONE)));
    assert!(in_view(&physics, &state, ME, Entity::Agent(OTHER)));
}

/// Bodies hide cells behind them, for both descriptions of the same view; only cells in or right behind a
/// disc differ.
#[test]
fn the_view_agrees_with_the_papers() {
    let mut random = random(3);
    let mut same = 0;
    let mut all = 0;
    for _ in 0..100 {
        let mut place = || {
            (random.random_range(8.0..24.0), random.random_range(4.0..20.0), random.random_range(0.0..6.0))
        };
        let (mut physics, state) = state([place(), place(), place(), place()]);
        physics.walls = Layout::new(18, None).unwrap().walls();
        let ours = field_of_view(&physics, &state, ME);
        let published = observe(&physics, &state, ME).visible;
        all += 400;
        same += Cell::all().filter(|&cell| ours.contains(cell) == published.contains(cell)).count();
    }
    assert!(f64::from(same as u32) / f64::from(all) > 0.985, "{same} of {all}");
}

#[test]
fn a_held_object_ahead_hides_what_is_behind_it() {
    let (physics, mut state) =
        state([(16.0, 9.0, AHEAD), (16.0, 20.0, 0.0), (9.0, 3.0, 0.0), (9.0, 5.0, 0.0)]);
    assert!(in_view(&physics, &state, ME, Entity::Agent(OTHER)));
    hold(&mut state, ME);
    assert!(!in_view(&physics, &state, ME, Entity::Agent(OTHER)));
    assert!(observe(&physics, &state, ME).observed.contains(Entity::Object(BALL)));
}

/// Outlines enlarged by a fifth touch where bodies come close; what touches an observed body is observed.
#[test]
fn touch_reaches_a_fifth_further_and_one_link() {
    let behind = |distance: f32| {
        let (physics, state) =
            state([(16.0, 12.0, AHEAD), (16.0, 4.0, 0.0), (16.0, 12.0 - distance, 0.0), (16.0, 2.9, 0.0)]);
        observe(&physics, &state, ME).observed
    };
    // The object's radius 0.8 u is enlarged to 0.96 u; the agent's base lies 0.8 u behind its origin.
    assert!(behind(1.75).contains(Entity::Object(BALL)));
    assert!(!behind(1.77).contains(Entity::Object(BALL)));
    // The other holds an object that cannot be seen itself.
    let (physics, mut hidden) =
        state([(16.0, 9.0, AHEAD), (16.0, 14.0, 0.0), (9.0, 3.0, 0.0), (9.0, 5.0, 0.0)]);
    hold(&mut hidden, OTHER);
    hidden.body_mut(Entity::Object(BALL)).position = Vec2::new(9.0, 3.0);
    assert!(observe(&physics, &hidden, ME).observed.contains(Entity::Object(BALL)));
}
