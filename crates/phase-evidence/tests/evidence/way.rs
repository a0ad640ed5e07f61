//! Obstructing another agent.

use crate::support::{Move, track};
use phase_evidence::blocking::{door_of, steps_between, steps_blocking_a_door};
use phase_model::{AgentId, Layout, SlotId, State, Vec2};
use phase_navigation::Map;

/// Layout 2 has a full wall above the centre, and left of it one with a door 5 u wide from x = 6 to 11.
fn map() -> Map {
    Map::new(Layout::new(2, None).expect("layout 2"))
}

/// Agent 0 at these points, agent 1 in room 3 on its way to room 0.
fn event(blocker: &[(f32, f32)]) -> phase_evidence::Track {
    track(blocker.iter().map(|&(x, y)| Move { agents: [(x, y, 0.0), (8.5, 6.0, 0.0)], ..Move::default() }))
}

fn to_room_0(_: &State) -> Option<Vec2> {
    Some(Vec2::new(8.5, 18.0))
}

#[test]
fn a_body_in_the_middle_of_a_door_blocks_it() {
    // Agent 1 is 3 u wide. A body of radius 1 in the middle leaves 1.5 u at both sides, at the side 3 u.
    let event = event(&[(8.5, 12.0), (8.5, 15.0), (7.0, 12.0), (9.0, 11.0), (20.0, 12.0)]);
    assert_eq!(steps_blocking_a_door(&event, &map(), AgentId::ZERO, to_room_0), [0, 3]);
    assert_eq!(steps_blocking_a_door(&event, &map(), AgentId::ZERO, |_| None), [0; 0]);
    let elsewhere = |_: &State| Some(Vec2::new(22.0, 6.0));
    assert_eq!(
        steps_blocking_a_door(&event, &map(), AgentId::ZERO, elsewhere),
        [0; 0],
        "another way is open"
    );
}

#[test]
fn between_is_near_the_line_and_nearer_to_the_end() {
    let event = event(&[(8.5, 12.0), (10.0, 12.0), (11.0, 12.0), (8.5, 4.0), (8.5, 20.5)]);
    assert_eq!(steps_between(&event, AgentId::ZERO, to_room_0), [0, 1]);
}

#[test]
fn the_door_someone_stands_in() {
    let event = event(&[(8.5, 12.5), (8.5, 13.5), (13.0, 12.0), (16.0, 6.0)]);
    let doors: Vec<Option<SlotId>> =
        event.states.iter().map(|state| door_of(&event, &map(), state, AgentId::ZERO)).collect();
    assert_eq!(doors, [Some(SlotId::LEFT), None, None, Some(SlotId::DOWN)]);
}
