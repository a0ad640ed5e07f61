//! The particle belief: what is observed is known, the rest is where it could be.

use crate::common::{BALL, ME, OTHER, on_landmark, random, scene};
use phase_model::{Action, Attitude, Entity, LandmarkId, ObjectId, Scene, State};
use phase_perception::Cell;
use phase_published::{Belief, PublishedParameters, senses::observe};

fn setting() -> (Scene, State) {
    let goals = [on_landmark(ME, LandmarkId::TOP_LEFT), on_landmark(OTHER, LandmarkId::TOP_LEFT)];
    let bodies = [(16.0, 9.0, 0.0), (16.0, 15.0, 0.0), (16.0, 4.0, 0.0), (9.0, 5.0, 0.0)];
    let scene = scene(0, goals, Attitude::Neutral, bodies);
    let state = scene.initial_state();
    (scene, state)
}

fn belief(scene: &Scene, state: &State, seed: u64) -> Belief {
    let observation = observe(&scene.physics(), state, ME);
    let parameters = PublishedParameters::default();
    Belief::new(scene.layout, &scene.physics(), &parameters, &observation, Some(state), &mut random(seed))
}

#[test]
fn the_observed_is_known_and_the_unseen_lies_where_it_is_not_seen() {
    let (scene, state) = setting();
    let observation = observe(&scene.physics(), &state, ME);
    let belief = belief(&scene, &state, 1);
    assert_eq!(belief.particles().len(), 50);
    for particle in belief.particles() {
        assert_eq!(particle.body(Entity::Agent(OTHER)), state.body(Entity::Agent(OTHER)));
        for object in [BALL, ObjectId::ONE] {
            let place = particle.position(Entity::Object(object));
            // The centre's own cell is covered by the body, whose outline avoids what is visible.
            let visible = Cell::at(place).is_some_and(|cell| observation.sees_cell(cell));
            assert!(!visible, "{place} is in view");
        }
    }
    let places =
        |object| belief.particles().iter().map(move |particle| particle.position(Entity::Object(object)));
    let spread = places(BALL).map(|place| place.x).fold(0.0, f32::max)
        - places(BALL).map(|place| place.x).fold(99.0, f32::min);
    assert!(spread > 8.0, "{spread}");
}

/// A body that is contradicted goes to the upper left corner of a cell, at rest.
#[test]
fn what_is_contradicted_goes_to_a_corner_of_an_unseen_cell() {
    let (scene, mut state) = setting();
    let mut belief = belief(&scene, &state, 2);
    let before: Vec<State> = belief.particles().to_vec();
    // The agent turns around and sees neither object, which the test has removed from where they were.
    state.body_mut(Entity::Agent(ME)).angle = core::f32::consts::PI;
    state.body_mut(Entity::Object(BALL)).position = (25.0, 21.0).into();
    state.body_mut(Entity::Object(ObjectId::ONE)).position = (23.0, 20.0).into();
    let observation = belief.observe(&state);
    assert!(!observation.observed.contains(Entity::Object(BALL)));
    belief.update(Action::TurnLeft, &observation, &[state], &mut random(3));
    let mut redrawn = 0;
    for (old, new) in before.iter().zip(belief.particles()) {
        let old = old.position(Entity::Object(BALL));
        let new = new.position(Entity::Object(BALL));
        if old.distance(new) > 1.0 {
            redrawn += 1;
            assert_eq!(new, new.round(), "not a corner");
        }
        assert!(!Cell::at(new).is_some_and(|cell| observation.sees_cell(cell)));
    }
    assert!(redrawn > 10, "{redrawn}");
}

#[test]
fn a_belief_survives_having_seen_everything() {
    let (scene, mut state) = setting();
    let mut belief = belief(&scene, &state, 4);
    let hidden = Entity::Object(BALL);
    for step in 0..40 {
        // The object jumps behind the turning agent.
        let angle = step as f32;
        state.body_mut(Entity::Agent(ME)).angle = angle;
        let back = state.body(Entity::Agent(ME)).position - state.body(Entity::Agent(ME)).forward() * 3.0;
        state.body_mut(hidden).position = back;
        let observation = belief.observe(&state);
        belief.update(Action::TurnLeft, &observation, &[state], &mut random(step));
        assert!(belief.particles().iter().all(|particle| particle.is_finite(&scene.physics())));
    }
}

#[test]
fn one_seed_makes_one_belief() {
    let (scene, state) = setting();
    assert_eq!(belief(&scene, &state, 7).particles(), belief(&scene, &state, 7).particles());
    assert_ne!(belief(&scene, &state, 7).particles(), belief(&scene, &state, 8).particles());
}
