//! Beliefs that an agent ascribes to the other.

use core::f32::consts::PI;
use phase_belief::{AscribedBelief, Glance};
use phase_model::{
    AgentBody, AgentId, Body, Entity, ObjectId, PhysicsConfig, Sight, State, Vec2, arena::LANDMARKS,
};

const OBJECT: Entity = Entity::Object(ObjectId::ZERO);

/// The object lies on a landmark, and agent 1, on landmark 0, faces it or away from it.
fn state(landmark: usize, faces: bool) -> State {
    let (here, place) = (LANDMARKS[0], LANDMARKS[landmark]);
    let towards = libm::atan2f(here.x - place.x, place.y - here.y);
    let other = Body::at_rest(here, if faces { towards } else { towards + PI });
    State::new([
        Body::at_rest(LANDMARKS[3], 0.0),
        other,
        Body::at_rest(place, 0.0),
        Body::at_rest(Vec2::ZERO, 0.0),
    ])
}

/// The room of the object in an ascribed belief, after each of the sets of particles.
fn ascribed(particles: &[&[State]], sees: Sight) -> Vec<[f64; 5]> {
    let agents = [AgentBody { radius: 0.8, max_force: 300.0 }; 2];
    let physics = PhysicsConfig { walls: Vec::new(), agents, object_radii: [0.8; 2], object_count: 1 };
    let glances: Vec<Glance> = particles.iter().map(|it| Glance::of(&physics, it, AgentId::ONE)).collect();
    AscribedBelief::along(&glances, sees).iter().map(|it| it.places(OBJECT)).collect()
}

#[test]
fn the_other_believes_what_it_is_believed_to_have_perceived() {
    let [seen, turned, gone] = [state(1, true), state(1, false), state(2, false)];
    // It sees the object, turns away, and the object is moved; of the last step half the particles have it
    // turned back.
    let looks = [state(2, true), gone];
    let found = ascribed(&[&[seen], &[turned], &[gone], &looks, &[gone]], Sight::Own);
    assert_eq!(found[0], [0.0, 0.0, 0.0, 0.0, 1.0]);
    assert_eq!(found[1], [0.0, 1.0, 0.0, 0.0, 0.0]);
    assert_eq!(found[2], [0.0, 1.0, 0.0, 0.0, 0.0], "a false belief");
    assert_eq!(found[3], [0.0, 0.5, 0.0, 0.0, 0.5]);
    assert_eq!(found[4], [0.0, 0.5, 0.5, 0.0, 0.0]);
}

#[test]
fn senses_beside_the_eyes_tell_of_objects() {
    let [turned, gone] = [state(1, false), state(2, false)];
    let particles: [&[State]; 2] = [&[turned], &[gone]];
    assert_eq!(ascribed(&particles, Sight::Own), [[0.25, 0.25, 0.25, 0.25, 0.0]; 2]);
    assert_eq!(ascribed(&particles, Sight::Start), [[0.0, 1.0, 0.0, 0.0, 0.0]; 2]);
    assert_eq!(ascribed(&particles, Sight::Objects), [[0.0, 1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0, 0.0]]);
    assert_eq!(ascribed(&[], Sight::Own), Vec::<[f64; 5]>::new());
}
