//! Where an agent looks for an object that was moved while it waited.

use crate::support::{Move, track};
use core::f32::consts::{FRAC_PI_2, PI};
use phase_evidence::{
    Track,
    search::{FirstLook, first_look, missed, was_moved},
};
use phase_model::{AgentId, Entity, ObjectId};

const OBJECT: Entity = Entity::Object(ObjectId::ZERO);

/// Agent 0 faces down in the lower left, while the object is moved in step 1 from the upper left to the lower
/// right; then it goes as `after` says.
fn waiting(after: &[(f32, f32, f32)]) -> Track {
    let before = [((8.0, 5.0, PI), (8.0, 19.0)), ((8.0, 5.0, PI), (23.0, 5.0))];
    let after = after.iter().map(|&pose| (pose, (23.0, 5.0)));
    track(before.into_iter().chain(after).map(|(pose, object)| Move {
        agents: [pose, (16.0, 3.0, 0.0)],
        objects: vec![object],
        ..Move::default()
    }))
}

#[test]
fn the_first_look_tells_where_the_object_is_believed() {
    let up = waiting(&[(8.0, 7.0, PI), (8.0, 7.0, 0.0), (8.0, 7.0, -FRAC_PI_2)]);
    assert!(was_moved(&up, OBJECT, 1) && missed(&up, AgentId::ZERO, OBJECT, 1));
    let look = first_look(&up, AgentId::ZERO, OBJECT, 1);
    assert_eq!(look, Some(FirstLook { step: 3, at_old_place: true, approach: 2.0 }));
    let right = waiting(&[(8.0, 5.0, PI), (11.0, 5.0, -FRAC_PI_2), (8.0, 5.0, 0.0)]);
    let look = first_look(&right, AgentId::ZERO, OBJECT, 1);
    assert_eq!(look, Some(FirstLook { step: 3, at_old_place: false, approach: 3.0 }));
    assert_eq!(first_look(&waiting(&[(8.0, 5.0, PI)]), AgentId::ZERO, OBJECT, 1), None);
}

#[test]
fn what_is_seen_or_stays_was_not_missed() {
    let seen = waiting(&[(8.0, 5.0, 0.0)]);
    assert!(!missed(&seen, AgentId::ZERO, OBJECT, 2), "it sees that the place is empty");
    assert!(!was_moved(&seen, OBJECT, 0), "not moved yet");
    assert!(!was_moved(&seen, OBJECT, 9), "the track is shorter");
}
