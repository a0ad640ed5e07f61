//! `fit-intents` on an event of a helper that has to find out what the other wants.

use crate::support::{recording, refuse, succeed, write_events};
use phase_event::Recording;
use phase_model::{Awareness, Level};
use phase_runs::event_writer::settings_value;
use serde_json::Value;
use std::fs;

#[test]
fn the_priors_with_the_least_score_are_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/behaviour/05b-carry.json");
    let recordings = phase_dataset::phase_events::read(scenes.as_ref()).expect("scenes");
    let mut scene = recordings[0].scene.clone();
    scene.agents.iter_mut().for_each(|agent| agent.awareness = Awareness::ignorant(Level::One));
    let mut settings = phase_sim::SimulationSettings::default();
    (settings.min_steps, settings.max_steps) = (40, 40);
    let event = phase_sim::simulate(&scene, 1, &settings).expect("an event");
    let settings = settings_value(&settings).expect("settings");
    let recording = Recording::of_event("unsure", event, "test".into(), settings);
    let event: Value = serde_json::from_str(&recording.to_json().expect("JSON").to_string()).expect("JSON");
    write_events(&path.join("events.json"), &[event]);
    let table = succeed(path, &["fit-intents", "--events", "events.json", "--out", "fit.json"]);
    let fit: Value = serde_json::from_slice(&fs::read(path.join("fit.json")).expect("a fit")).expect("JSON");
    let rows: Vec<Vec<f64>> = table
        .lines()
        .filter_map(|line| line.split_whitespace().take(5).map(|it| it.parse().ok()).collect())
        .filter(|row: &Vec<f64>| row.len() == 5)
        .collect();
    assert_eq!(rows.len(), 18, "{table}");
    let least = rows.iter().map(|row| row[3]).fold(f64::INFINITY, f64::min);
    let [knows, level_zero] = ["knows", "level_zero"].map(|it| fit[it].as_f64().expect("a number"));
    let fitted = rows.iter().find(|row| (row[0] - knows).abs() < 0.01 && (row[1] - level_zero).abs() < 0.01);
    assert!(fitted.is_some_and(|row| row[3] <= least + 1e-9), "{knows}, {level_zero}: {table}");
    let most = rows.iter().map(|row| row[3]).fold(0.0, f64::max);
    assert!(most > least, "the priors make no difference: {table}");
}

#[test]
fn recordings_without_beliefs_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    write_events(&folder.path().join("events.json"), &[recording("measured")]);
    let said = refuse(folder.path(), &["fit-intents", "--events", "events.json"]);
    assert!(said.contains("measured") && said.contains("was not simulated"), "{said}");
}
