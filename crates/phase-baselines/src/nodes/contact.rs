//! Contacts between bodies, as seen from outside: by distance, since an
//! [`ObservedEvent`](phase_event::ObservedEvent) has no contacts.

use super::MOVING;
use phase_model::{Segment, Vec2};

/// Share of the sum of two radii within which their bodies count as in contact, as in the published
/// SocialGNN. Beyond 1, because outlines that touch may be as far from each other as the corners of an
/// agent's trapezoid.
const REACH: f32 = 1.2;

/// The pairs of moving nodes that are in contact at one row: symmetric, and false on its diagonal.
pub type ContactMatrix = [[bool; MOVING]; MOVING];

/// The contacts among the first `count` bodies, which have these positions (u) and radii (u): those closer
/// than [`REACH`] times the sum of their radii, without a wall between their centres.
pub(super) fn contacts(
    positions: &[Vec2; MOVING],
    radii: &[f32; MOVING],
    count: usize,
    walls: &[Segment],
) -> ContactMatrix {
    let mut matrix = [[false; MOVING]; MOVING];
    for b in 0..count.min(MOVING) {
        for a in 0..b {
            let between = Segment { a: positions[a], b: positions[b] };
            let near = between.length() < REACH * (radii[a] + radii[b]);
            let contact = near && !walls.iter().any(|wall| wall.crosses(between));
            matrix[a][b] = contact;
            matrix[b][a] = contact;
        }
    }
    matrix
}
