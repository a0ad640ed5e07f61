//! Two tracks that begin alike.

use crate::support::{Move, track};
use phase_evidence::parting::Parting;
use phase_model::{AgentId, Entity, Vec2};

/// Agent 1 goes right by 1 u a step; from a step on, it goes up by some distance a step as well. The object
/// follows it two steps later.
fn moves(steps: usize, from: usize, up: f32) -> Vec<Move> {
    let height = |t: usize, from: usize| t.saturating_sub(from) as f32 * up;
    (0..=steps)
        .map(|t| Move {
            agents: [(0.0, 0.0, 0.0), (t as f32, height(t, from), 0.0)],
            objects: vec![(5.0, 5.0 + height(t, from + 2))],
            ..Move::default()
        })
        .collect()
}

#[test]
fn two_tracks_part_where_a_body_is_visibly_elsewhere() {
    let parting = Parting::of(&track(moves(10, 10, 0.0)), &track(moves(8, 3, 0.4)));
    assert_eq!(parting.first, Some(4));
    // 0.4 u after step 4 is not seen, 0.8 u after step 5 is.
    let seen = parting.seen.expect("a difference");
    assert_eq!((seen.step, seen.entity), (5, Entity::Agent(AgentId::ONE)));
    assert_eq!(seen.places[0], Vec2::new(5.0, 0.0));
    assert!(seen.places[1].distance(Vec2::new(5.0, 0.8)) < 1e-6);
    assert_eq!(parting.entities, [None, Some(5), Some(7)]);
    assert!((parting.farthest - 2.0).abs() < 1e-6, "after the eighth step, the last of the shorter track");
}

#[test]
fn equal_tracks_do_not_part() {
    let one = track(moves(5, 2, 1.0));
    let parting = Parting::of(&one, &one);
    assert_eq!((parting.first, parting.seen, parting.farthest), (None, None, 0.0));
}
