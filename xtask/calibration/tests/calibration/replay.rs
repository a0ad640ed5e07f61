//! Recordings with known actions become replays.

use phase_calibration::Replay;
use phase_event::Recording;
use phase_model::Action;
use serde_json::{Value, json};

fn recording(flip: Option<u8>, actions: &Value) -> Recording {
    let row = |x: f64| json!([x, 14.0, 0.5, -0.25, 1.5]);
    let track = |x: f64| json!([row(x), row(x + 0.125), row(x + 0.25)]);
    let agent = json!({"size_level": 0, "strength_level": 2, "alpha": 0,
        "goal": {"kind": "object_on_landmark", "object": 0, "landmark": 2, "sign": 1}});
    let event = json!({
        "id": "made-up-1", "layout": {"base": 4, "flip": flip}, "agents": [agent, agent],
        "objects": [{"size_level": 1}], "event": "collaborating",
        "trajectory": {"columns": ["x", "y", "vx", "vy", "angle"],
                       "agents": [track(8.0), track(12.0)], "objects": [track(20.0)]},
        "recovered_actions": {"steps": actions},
    });
    Recording::from_value(&event).expect("a good event")
}

#[test]
fn recordings_with_known_actions_can_be_replayed() {
    let actions = json!([["turnright", "turnleft"], ["up", "attach"]]);
    let recorded = recording(None, &actions);
    let replay = Replay::of_recording(&recorded).expect("a replay");
    assert_eq!((replay.id.as_str(), &replay.physics), ("made-up-1", &recorded.scene.physics()));
    assert_eq!(replay.actions, [[Action::TurnLeft; 2], [Action::Up, Action::Attach]]);
    assert_eq!(Some(replay.initial), recorded.trajectory.state(0));
    let rows = [1, 2].map(|t| recorded.trajectory.state(t).expect("a row").bodies);
    assert_eq!(replay.rows, rows);
}

#[test]
fn mirrored_recordings_and_those_without_actions_cannot() {
    assert_eq!(Replay::of_recording(&recording(Some(2), &json!([["up", "up"]]))), None, "mirrored");
    assert_eq!(Replay::of_recording(&recording(None, &json!([]))), None, "nothing known");
}
