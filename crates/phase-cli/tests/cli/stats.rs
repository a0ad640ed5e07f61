//! Figures of events.

use crate::support::{recording, refuse, succeed, write_events};
use serde_json::{Value, json};
use std::fs;

#[test]
fn clarity_is_told_by_kind_and_beside_it_what_people_would_report() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    write_events(&path.join("events.json"), &[recording("first"), recording("second")]);
    let plain = succeed(path, &["stats", "events.json", "--out", "figures"]);
    assert!(plain.contains("| clarity: mean | events | knotted_share |"), "{plain}");
    assert!(!plain.contains("label reported"));
    let table = fs::read_to_string(path.join("figures/motion.csv")).expect("a table");
    assert!(
        table
            .lines()
            .next()
            .is_some_and(|head| head.ends_with(",trying_0_steps,trying_1_steps,shown_0_u,shown_1_u")),
        "{table}"
    );

    succeed(path, &["eval", "goals", "--method", "cue", "--events", "events.json", "--out", "cue"]);
    let stats = ["stats", "events.json", "--results", "cue/results.json"];
    let told = succeed(path, &stats);
    // `cue` predicts no reports.
    let is_row = |row: &str| row.starts_with("| independent |") && row.contains(" | – | 0 of 0 | ");
    assert!(told.lines().any(is_row), "{told}");
    assert!(told.contains(" goals right: shown | not shown |"), "{told}");

    let text = fs::read_to_string(path.join("cue/results.json")).expect("results");
    let mut results: Value = serde_json::from_str(&text).expect("JSON");
    for (event, neutral) in results["events"].as_array_mut().expect("events").iter_mut().zip([0.75, 0.25]) {
        event["reported"] = json!({ "friendly": 1.0 - neutral, "adversarial": 0.0, "neutral": neutral });
    }
    fs::write(path.join("cue/results.json"), results.to_string()).expect("written");
    let told = succeed(path, &stats);
    // Both are independent, so that neutral is their label.
    assert!(
        told.lines().any(|row| row.starts_with("| independent |") && row.contains(" 0.50 | 1 of 2 | ")),
        "{told}"
    );
    assert!(
        refuse(path, &["stats", "events.json", "--results", "events.json"]).contains("phase-eval-goals/1")
    );
    // Events of the same names, one of which has another goal.
    let mut other = recording("second");
    other["agents"][1]["goal"]["landmark"] = json!(2);
    write_events(&path.join("changed.json"), &[recording("first"), other]);
    let refused = refuse(path, &["stats", "changed.json", "--results", "cue/results.json", "--quiet"]);
    let rule = "field `run.events_sha256` is not that of the events of changed.json";
    assert!(refused.contains("cue/results.json") && refused.contains(rule), "{refused}");
    // Results may be those of the first events.
    let first = ["--events", "events.json", "--limit", "1", "--out", "one"];
    succeed(path, &[&["eval", "goals", "--method", "cue"], &first[..]].concat());
    succeed(path, &["stats", "events.json", "--results", "one/results.json"]);
    for event in results["events"].as_array_mut().expect("events") {
        event["id"] = json!(format!("other-{}", event["id"].as_str().expect("a name")));
    }
    fs::write(path.join("others.json"), results.to_string()).expect("written");
    let refused = refuse(path, &["stats", "events.json", "--results", "others.json", "--quiet"]);
    assert!(refused.contains("others.json") && refused.contains("field events must have one"), "{refused}");
}
