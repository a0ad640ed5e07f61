//! `check-forecasts` on a simulated event.

use crate::support::{recording, refuse, succeed, write_events};
use phase_event::Recording;
use phase_runs::event_writer::settings_value;
use serde_json::Value;

#[test]
fn the_error_of_forecasts_is_divided_without_a_rest() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/behaviour/05b-carry.json");
    let scene = phase_dataset::phase_events::read(scenes.as_ref()).expect("scenes").remove(0).scene;
    let mut settings = phase_sim::SimulationSettings::default();
    (settings.min_steps, settings.max_steps) = (24, 24);
    let event = phase_sim::simulate(&scene, 1, &settings).expect("an event");
    let settings = settings_value(&settings).expect("settings");
    let recording = Recording::of_event("together", event, "test".into(), settings);
    let event: Value = serde_json::from_str(&recording.to_json().expect("JSON").to_string()).expect("JSON");
    write_events(&path.join("events.json"), &[event]);
    let table = succeed(path, &["check-forecasts", "--events", "events.json"]);
    let first = |name: &str| -> f64 {
        let line = table.lines().find(|line| line.starts_with(name)).expect("a row");
        let value = line[name.len()..].split_whitespace().next().expect("a value");
        value.parse().expect("a number")
    };
    let parts = ["inference", "minds", "chance"].map(first);
    assert!((parts.iter().sum::<f64>() - first("simple")).abs() < 0.02, "{table}");
    // Where one went in four steps of a second is near where it would go with other random numbers.
    assert!((0.0..3.0).contains(&first("chance")), "{table}");
}

#[test]
fn nothing_is_held_out_where_nothing_is_fitted() {
    let folder = tempfile::tempdir().expect("a folder");
    write_events(&folder.path().join("events.json"), &[recording("measured")]);
    for command in ["check-forecasts", "check-search"] {
        let said = refuse(folder.path(), &[command, "--events", "events.json", "--held-out", "events.json"]);
        assert!(said.contains("--held-out: nothing is fitted here"), "{said}");
    }
}
