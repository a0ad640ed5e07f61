//! Standalone scenes, events and recordings, through serde.

use crate::support::{file, plain_event};
use phase_event::{Event, EventReadError, Recording, from_json, to_json};
use phase_model::Scene;
use serde_json::{Value, json};

fn recording() -> Recording {
    Recording::of_event("event-1", plain_event(2), "phase test".into(), json!({"max_steps": 3}))
}

#[test]
fn one_event_of_a_file_is_a_recording() {
    let file = file();
    let text = file["events"][0].to_string();
    let read = Recording::from_json(&text).expect("a good event");
    assert_eq!(from_json(&file.to_string()), Ok(vec![read.clone()]));
    assert_eq!(serde_json::from_str::<Recording>(&text).expect("a good event"), read);
    let written = read.to_json().expect("finite");
    assert!(to_json(&[read]).expect("finite").contains(&written));
}

#[test]
fn an_event_comes_back_without_its_recording() {
    let event = plain_event(3);
    let text = event.to_json().expect("finite");
    assert_eq!(Event::from_json(&text), Ok(event.clone()));
    let value = serde_json::to_value(&event).expect("finite");
    assert!(value.get("id").is_none() && value.get("settings").is_none());
    assert_eq!(serde_json::from_value::<Event>(value).expect("an event"), event);
    let whole = recording();
    let text = serde_json::to_string(&whole).expect("finite");
    assert_eq!(Event::from_json(&text), Ok(whole.simulation.expect("a simulation").event));
}

#[test]
fn a_recording_that_was_not_simulated_is_no_event() {
    let error = Event::from_json(&file()["events"][0].to_string()).expect_err("no substeps");
    assert_eq!(error.to_string(), "field `substeps` is missing");
}

#[test]
fn a_scene_comes_back_with_all_of_its_start() {
    let mut scene = recording().scene;
    scene.agents[1].start.angular_velocity = 0.1;
    scene.objects[0].start.velocity.y = -1.0 / 3.0;
    let text = scene.to_json().expect("finite");
    assert_eq!(Scene::from_json(&text), Ok(scene.clone()));
    assert_eq!(serde_json::from_str::<Scene>(&text).expect("a scene"), scene);
    assert_eq!(serde_json::from_value::<Vec<Scene>>(json!([scene])).expect("a scene"), [scene]);
}

/// Both readers give the same error for the members that both read.
#[test]
fn what_is_wrong_with_a_scene_is_said_as_of_an_event() {
    let scene: Value = serde_json::to_value(recording().scene).expect("finite");
    let cases: &[(&str, Value, &str)] = &[
        ("/layout/base", json!(22), "field `layout.base` must be a whole number from 0 to 21, not 22"),
        ("/agents/0/goal/sign", json!(0), "field `agents[0].goal.sign` must be 1 or -1, not 0"),
        ("/agents/1/start/x", json!("8"), "field `agents[1].start.x` must be a finite number, not \"8\""),
        ("/agents/1/start/x", json!(5), "agents[1].start must lie inside the arena (x 6 to 26, y 2 to 22)"),
        ("/objects/0", json!({"size_level": 0}), "field `objects[0].start` is missing"),
        ("/objects/0/start", json!({"x": 8, "y": 8, "z": 8}), "field `objects[0].start.z` is unknown"),
        ("/event", json!("dancing"), "field `event` must be one of helping"),
        ("/agents/1/alpha", json!(1), "at most one agent may have an attitude `alpha`"),
    ];
    for (pointer, replacement, start) in cases {
        let mut value = scene.clone();
        *value.pointer_mut(pointer).expect(pointer) = replacement.clone();
        let sentence = Scene::from_json(&value.to_string()).expect_err(pointer).to_string();
        assert!(sentence.starts_with(start), "{pointer}: {sentence}");
        let by_serde = serde_json::from_value::<Scene>(value).expect_err(pointer).to_string();
        assert_eq!(by_serde, sentence);
    }
}

#[test]
fn nothing_is_written_with_a_number_that_json_cannot_hold() {
    let mut recording = recording();
    recording.trajectory.agents[0][1][2] = f32::NAN;
    assert!(recording.to_json().is_err() && serde_json::to_value(&recording).is_err());
    let mut event = plain_event(1);
    event.steps[0].thoughts[0].actions[3].value = f64::INFINITY;
    assert!(event.to_json().is_err() && serde_json::to_value(&event).is_err());
    let mut scene = event.scene;
    scene.objects[1].start.angle = f32::NEG_INFINITY;
    let error = scene.to_json().expect_err("not finite").to_string();
    assert_eq!(error, "objects[1].start must hold finite numbers");
}

#[test]
fn an_event_by_itself_needs_an_id_to_be_a_recording() {
    let text = plain_event(0).to_json().expect("finite");
    let error = Recording::from_json(&text).expect_err("no id");
    assert!(matches!(error, EventReadError::Field { event: None, .. }));
    assert_eq!(error.to_string(), "field `id` is missing");
}
