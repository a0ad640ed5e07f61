//! Holding objects, and carrying together.

use crate::support::{Move, track};
use phase_evidence::holding::{HoldInterval, carried, carried_together, holds};
use phase_model::{AgentId, ObjectId};

/// Object 0 at x, held by the given agents.
fn at(x: f32, held: [Option<u8>; 2]) -> Move {
    Move { agents: [(8.0, 8.0, 0.0), (20.0, 8.0, 0.0)], objects: vec![(x, 4.5), (20.0, 20.0)], held }
}

fn event() -> phase_evidence::Track {
    let moves = [
        at(10.0, [None, None]),
        at(10.0, [Some(0), None]),
        at(11.0, [Some(0), None]),
        at(13.0, [Some(0), Some(0)]),
        at(14.5, [Some(0), Some(0)]),
        at(14.5, [None, Some(0)]),
        at(14.0, [Some(1), Some(0)]),
        at(14.0, [Some(1), None]),
    ];
    track(moves)
}

#[test]
fn holds_are_found_with_their_times() {
    let expected = [
        HoldInterval { agent: AgentId::ZERO, object: ObjectId::ZERO, from: 1, to: 4 },
        HoldInterval { agent: AgentId::ZERO, object: ObjectId::ONE, from: 6, to: 7 },
        HoldInterval { agent: AgentId::ONE, object: ObjectId::ZERO, from: 3, to: 6 },
    ];
    assert_eq!(holds(&event()), expected);
    assert_eq!(expected.map(|hold| hold.steps()), [4, 2, 4]);
}

#[test]
fn a_hold_from_the_start_counts_and_other_objects_part_it() {
    let moves = [at(9.0, [Some(0), None]), at(9.0, [Some(1), None]), at(9.0, [Some(0), None])];
    let objects: Vec<(ObjectId, usize)> =
        holds(&track(moves)).iter().map(|it| (it.object, it.from)).collect();
    assert_eq!(objects, [(ObjectId::ZERO, 0), (ObjectId::ONE, 1), (ObjectId::ZERO, 2)]);
}

#[test]
fn carrying_is_counted_with_its_way() {
    let event = event();
    let together = carried_together(&event, ObjectId::ZERO);
    assert_eq!(together.steps, 2);
    assert!((together.distance - 3.5).abs() < 1e-5, "{together:?}");
    // Landmark 3 is at (8.5, 4.5), on the object's line.
    assert!((together.approach[3] + 3.5).abs() < 1e-4, "{together:?}");
    let first = carried(&event, AgentId::ZERO, ObjectId::ZERO);
    assert_eq!(first.steps, 4);
    assert!((first.distance - 4.5).abs() < 1e-5, "{first:?}");
    let second = carried(&event, AgentId::ONE, ObjectId::ZERO);
    assert!((second.distance - 4.0).abs() < 1e-5, "the way back counts too: {second:?}");
    assert!((second.approach[3] + 3.0).abs() < 1e-4, "but towards the landmark: {second:?}");
    assert_eq!(carried(&event, AgentId::ONE, ObjectId::ONE).steps, 0);
}

#[test]
fn distances_add_up() {
    let event = event();
    let object = phase_model::Entity::Object(ObjectId::ZERO);
    assert!((event.distance_travelled(object, 0..8) - 5.0).abs() < 1e-5);
    assert!((event.distance_travelled(object, 2..4) - 3.0).abs() < 1e-5);
    assert_eq!(event.distance_travelled(object, 8..100), 0.0);
}
