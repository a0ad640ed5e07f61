//! Distances between outlines, and touching.

use crate::support::{Move, track};
use phase_evidence::contact::{TOUCH_GAP, gap, steps_touching};
use phase_model::{AgentId, Contacts, Entity, ObjectId};

/// Agents of radius 1 have a base of 3 u at the rear, 1 u behind their origin, and a front 1 u before it.
#[test]
fn gaps_of_all_pairs() {
    let cases = [
        // Side by side, both face up: the bases end 1.5 u from the origins.
        (Entity::Agent(AgentId::ZERO), Entity::Agent(AgentId::ONE), 2.0),
        // The object's edge is 1 u from its centre, straight above agent 0's front.
        (Entity::Agent(AgentId::ZERO), Entity::Object(ObjectId::ZERO), 3.0),
        (Entity::Object(ObjectId::ZERO), Entity::Object(ObjectId::ONE), 4.0),
    ];
    let moves = Move {
        agents: [(10.0, 10.0, 0.0), (15.0, 10.0, 0.0)],
        objects: vec![(10.0, 15.0), (10.0, 21.0)],
        ..Move::default()
    };
    let track = track([moves]);
    for (a, b, expected) in cases {
        for (a, b) in [(a, b), (b, a)] {
            let gap = gap(&track.physics, &track.states[0], a, b);
            assert!((gap - expected).abs() < 1e-5, "{a:?} {b:?}: {gap}");
        }
    }
}

#[test]
fn touching_is_being_near_or_in_contact_or_held() {
    let at = |x: f32| Move { agents: [(x, 10.0, 0.0), (15.0, 10.0, 0.0)], ..Move::default() };
    let mut track = track([at(8.0), at(12.0 - 0.5 * TOUCH_GAP), at(12.0 - 1.5 * TOUCH_GAP), at(8.0)]);
    assert_eq!(steps_touching(&track, Entity::Agent(AgentId::ZERO), Entity::Agent(AgentId::ONE)), [1]);
    let mut contacts = Contacts::NONE;
    contacts.insert(Entity::Agent(AgentId::ZERO), Entity::Agent(AgentId::ONE));
    track.states[3].contacts = contacts;
    assert_eq!(steps_touching(&track, Entity::Agent(AgentId::ONE), Entity::Agent(AgentId::ZERO)), [1, 3]);
}
