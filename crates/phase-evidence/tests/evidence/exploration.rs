//! The region that an agent explores first.

use crate::support::{Move, track};
use core::f32::consts::{FRAC_PI_2, PI};
use phase_evidence::exploration::searched_first;
use phase_model::{AgentId, RoomId};

/// Agent 0 stands in the middle of room 2 and faces somewhere at each step; agent 1 is out of sight in room
/// 0.
fn turning(angles: &[f32]) -> phase_evidence::Track {
    let one = |&angle: &f32| Move { agents: [(21.0, 7.0, angle), (7.5, 20.5, 0.0)], ..Move::default() };
    track(angles.iter().map(one))
}

/// The region that was searched first, and the step.
type Found = Option<(usize, usize)>;

#[test]
fn the_first_region_half_seen_counts() {
    // Down: neither region. Up: room 1. Left: room 3.
    let cases: [(&[f32], Found); 4] = [
        (&[PI, PI], None),
        (&[PI, 0.0, FRAC_PI_2], Some((0, 1))),
        (&[PI, PI, FRAC_PI_2, 0.0], Some((1, 2))),
        (&[], None),
    ];
    for (angles, expected) in cases {
        assert_eq!(
            searched_first(&turning(angles), AgentId::ZERO, &[&[RoomId::TOP_RIGHT], &[RoomId::BOTTOM_LEFT]]),
            expected,
            "{angles:?}"
        );
    }
}

#[test]
fn what_was_seen_at_the_start_is_no_search() {
    // Facing up it sees room 1 at once; nothing is left to search but what is hidden.
    let first = searched_first(
        &turning(&[0.0, FRAC_PI_2]),
        AgentId::ZERO,
        &[&[RoomId::TOP_RIGHT], &[RoomId::BOTTOM_LEFT]],
    );
    assert_eq!(first, Some((1, 1)));
}
