//! `fit-reports` on results of a few events.

use crate::support::{refuse, succeed};
use serde_json::{Value, json};
use std::{fs, path::Path};

/// Results of events in which help, hindrance or nothing goes on, and most people report it.
fn results(rated: bool, impression: bool) -> Value {
    let event = |k: usize| {
        let mut happenings = [0.01; 6];
        happenings[[0, 1, 5][k % 3]] = 0.95;
        let mut counts = [1, 1, 1];
        counts[k % 3] = 8;
        let goal = json!({ "kind": "agent_on_landmark", "agent": 0, "landmark": 1, "sign": 1 });
        let mut event = json!({
            "id": format!("event-{k}"), "goals": [[], []],
            "relation": { "friendly": 0.25, "adversarial": 0.25, "neutral": 0.5 },
            "watched": [], "cpu_seconds": null, "details": null,
            "label": { "kind": "independent", "goals": [goal, goal], "relation": "neutral",
                       "relation_human": null, "layout_seen": null },
        });
        if rated {
            event["label"]["ratings"] =
                json!({ "friendly": counts[0], "adversarial": counts[1], "neutral": counts[2] });
        }
        if impression {
            let interaction = json!({ "near": 0.1, "shared_object": 0.0 });
            event["details"] =
                json!({ "impression": { "happenings": happenings, "interaction": interaction } });
        }
        event
    };
    json!({ "format": "phase-eval-goals/1", "events": (0..18).map(event).collect::<Vec<_>>() })
}

fn write(path: &Path, results: &Value) {
    fs::write(path.join("results.json"), results.to_string()).expect("written");
}

#[test]
fn reports_that_follow_what_goes_on_are_predicted_for_other_events() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    write(path, &results(true, true));
    let fit = ["fit-reports", "--results", "results.json", "--folds", "3", "--out", "model.json"];
    let table = succeed(path, &fit);
    let held_out = table.lines().find(|line| line.starts_with("a model that did not see")).expect("a line");
    let correlation: f64 =
        held_out.split_whitespace().find_map(|word| word.parse().ok()).expect("a correlation");
    assert!(correlation > 0.99, "{held_out}");
    let model: Value =
        serde_json::from_slice(&fs::read(path.join("model.json")).expect("a file")).expect("JSON");
    assert_eq!(model["format"], "phase-report-model/1");
    assert_eq!(succeed(path, &fit), table);
}

/// The record has the figures that are printed, each with its protocol.
#[test]
fn the_record_says_which_figures_are_held_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let fit = ["fit-reports", "--results", "results.json", "--folds", "3", "--record", "record.json"];
    write(path, &results(true, true));
    let told = refuse(path, &fit);
    assert!(told.contains("results.json: field run.events_sha256 is missing"), "{told}");
    let mut results = results(true, true);
    results["run"] = json!({ "events_sha256": "ab" });
    write(path, &results);
    let table = succeed(path, &fit);
    let record: Value =
        serde_json::from_slice(&fs::read(path.join("record.json")).expect("a file")).expect("JSON");
    assert_eq!(
        (&record["format"], &record["events_sha256"]),
        (&json!("phase-report-training/1"), &json!("ab"))
    );
    assert_eq!(record["in_sample"]["protocol"], "in-sample");
    assert_eq!(record["held_out"]["protocol"], json!({ "held-out": { "folds": 3 } }));
    for (row, field) in
        [("a model that did not see the event", "held_out"), ("the model fitted to all events", "in_sample")]
    {
        let line = table.lines().find(|line| line.starts_with(row)).expect("a line");
        let value = record[field]["cross_entropy"]["value"].as_f64().expect("a number");
        assert!(line.contains(&format!(" {value:.3} [")), "{line}: {value}");
    }
    assert_ne!(record["in_sample"]["cross_entropy"], record["held_out"]["cross_entropy"]);
}

#[test]
fn results_that_nothing_can_be_fitted_to_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let fit = ["fit-reports", "--results", "results.json"];
    assert!(refuse(path, &fit).contains("results.json"));
    for (results, rule) in [
        (results(false, true), "no event was rated"),
        (results(true, false), "event event-0: there is no impression"),
        (json!({ "format": "phase-events/1" }), "format must be \"phase-eval-goals/1\""),
        (json!({ "format": "phase-eval-goals/1", "events": [1] }), "cannot be read"),
    ] {
        write(path, &results);
        let told = refuse(path, &fit);
        assert!(told.contains(rule), "{told}");
    }
    write(path, &results(true, true));
    let told = refuse(path, &[&fit[..], &["--folds", "19"]].concat());
    assert!(told.contains("18 rated events, fewer than --folds 19"), "{told}");
}
