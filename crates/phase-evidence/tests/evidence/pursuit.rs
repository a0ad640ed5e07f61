//! Pursuing and escaping.

use crate::support::{Move, track};
use phase_evidence::pursuit::Pursuit;
use phase_model::{AgentId, Layout, Vec2};
use phase_navigation::{IMPASSABLE_COST, Map};

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

/// A wall with a door at its end parts the two: who goes to the door goes away from the other as the crow
/// flies, and towards it by the way.
#[test]
fn the_way_to_another_room_leads_through_the_door() {
    let layout = Layout::new(16, None).expect("a known layout");
    let map = Map::new(layout);
    let other = Vec2::new(14.0, 16.0);
    let start = Vec2::new(14.0, 11.0);
    let width = 2.0 * 0.8;
    let route = map.route(start, other, width, map.gaps(), IMPASSABLE_COST).expect("a way");
    assert!(route.length > 1.3 * start.distance(other), "there is a wall: {route:?}");
    let places = [0.0, 1.0, 2.0, 3.0].map(|way| route.at(start, other, way));
    let mut chase =
        track(places.map(|place| Move {
            agents: [(place.x, place.y, 0.0), (other.x, other.y, 0.0)],
            ..Move::default()
        }));
    chase.physics.walls = layout.walls();
    let straight = Pursuit::of(&chase, AgentId::ZERO);
    assert_eq!((straight.moving, straight.towards), (3, 0));
    let by_way = Pursuit::by_way(&chase, AgentId::ZERO, &map);
    assert_eq!((by_way.moving, by_way.towards, by_way.away), (3, 3, 0));
}

#[test]
fn going_across_is_neither() {
    let moves = [(10.0, 8.0), (10.0, 10.0)]
        .map(|(x, y)| Move { agents: [(x, y, 0.0), (20.0, 8.0, 0.0)], ..Move::default() });
    let across = Pursuit::of(&track(moves), AgentId::ZERO);
    assert_eq!((across.moving, across.towards, across.away), (1, 0, 0));
}
