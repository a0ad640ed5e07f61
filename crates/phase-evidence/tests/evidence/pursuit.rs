//! Pursuing and escaping.

use crate::support::{Move, track};
use phase_evidence::pursuit::Pursuit;
use phase_model::AgentId;

fn event(agents: &[(f32, f32)]) -> phase_evidence::Track {
    track(
        agents.iter().map(|&(chaser, fleer)| Move {
            agents: [(chaser, 8.0, 0.0), (fleer, 8.0, 0.0)],
            ..Move::default()
        }),
    )
}

#[test]
fn a_chase_along_a_line() {
    // The chaser follows in every step; the fleer runs, stops, and at last runs past its chaser.
    let chase = event(&[(8.0, 12.0), (10.0, 14.0), (12.0, 14.0), (13.0, 17.0), (14.0, 10.0)]);
    let chaser = Pursuit::of(&chase, AgentId::ZERO);
    assert_eq!((chaser.moving, chaser.towards, chaser.away, chaser.rooms_changed), (4, 4, 0, 0));
    assert!(chaser.closed.abs() < 1e-5, "4 u apart at the start and at the end: {chaser:?}");
    assert!((chaser.nearest - 2.0).abs() < 1e-5, "{chaser:?}");
    let fleer = Pursuit::of(&chase, AgentId::ONE);
    // Rooms 3 and 2 meet at x = 16: there and back again.
    assert_eq!((fleer.moving, fleer.towards, fleer.away, fleer.rooms_changed), (3, 1, 2, 2));
}

#[test]
fn going_across_is_neither() {
    let moves = [(10.0, 8.0), (10.0, 10.0)]
        .map(|(x, y)| Move { agents: [(x, y, 0.0), (20.0, 8.0, 0.0)], ..Move::default() });
    let across = Pursuit::of(&track(moves), AgentId::ZERO);
    assert_eq!((across.moving, across.towards, across.away), (1, 0, 0));
}
