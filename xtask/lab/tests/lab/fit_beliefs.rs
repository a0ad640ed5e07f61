//! `fit-beliefs` on an event of false belief, with a mind that searches little.

use crate::support::{recording, refuse, succeed, write_events};
use phase_event::Recording;
use phase_runs::event_writer::settings_value;
use serde_json::Value;
use std::fs;

#[test]
fn the_temperature_with_the_least_score_is_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/behaviour/11a-false-belief.json");
    let recordings = phase_dataset::phase_events::read(scenes.as_ref()).expect("scenes");
    let scene = &recordings[0].scene;
    let mut settings = phase_sim::SimulationSettings::default();
    (settings.min_steps, settings.max_steps) = (52, 52);
    let event = phase_sim::simulate(scene, 1, &settings).expect("an event");
    let settings = settings_value(&settings).expect("settings");
    let recording = Recording::of_event("unaware", event, "test".into(), settings);
    let event: Value = serde_json::from_str(&recording.to_json().expect("JSON").to_string()).expect("JSON");
    write_events(&path.join("events.json"), &[event]);
    let table = succeed(path, &["fit-beliefs", "--events", "events.json", "--out", "fit.json"]);
    let fit: Value = serde_json::from_slice(&fs::read(path.join("fit.json")).expect("a fit")).expect("JSON");
    let fitted = fit["inverse_temperature"].as_f64().expect("a number");
    let brier = |line: &str| line.split_whitespace().nth(2)?.parse::<f64>().ok();
    let rows = table.lines().filter(|line| line.trim_start().starts_with(char::is_numeric));
    let scores: Vec<(f64, f64)> =
        rows.filter_map(|line| Some((line.split_whitespace().next()?.parse().ok()?, brier(line)?))).collect();
    assert_eq!(scores.len(), 8, "{table}");
    let least = scores.iter().map(|it| it.1).fold(f64::INFINITY, f64::min);
    let of_fitted = scores.iter().find(|it| (it.0 - fitted).abs() < 0.01).expect("a row");
    assert!(of_fitted.1 <= least + 1e-9, "{fitted}: {table}");
    assert!(scores[0].1 > least, "knowledge makes no difference: {table}");
}

#[test]
fn recordings_without_beliefs_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    write_events(&folder.path().join("events.json"), &[recording("measured")]);
    let said = refuse(folder.path(), &["fit-beliefs", "--events", "events.json"]);
    assert!(said.contains("measured") && said.contains("was not simulated"), "{said}");
}
