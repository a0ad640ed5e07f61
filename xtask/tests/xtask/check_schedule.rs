//! `check-schedule`: simulated runs of attempts whose times are known.

use crate::support::{refuse, run, text};
use serde_json::{Value, json};
use std::{fs, path::Path};

/// An attempt whose event takes so many seconds; if it is accepted, as many with an idle agent, and one second for the files.
fn attempt(slot: usize, number: usize, seconds: f64, accepted: bool) -> Value {
    let idle = json!({"part": {"idle": {"member": 0, "agent": 0}}, "cpu_seconds": seconds});
    let member = json!({"part": {"member": 0}, "cpu_seconds": seconds});
    json!({"attempt": {
        "slot": slot, "attempt": number, "variants": ["drag"], "passed": usize::from(accepted), "accepted": accepted,
        "scenes": 0.0, "parts": if accepted { vec![member, idle] } else { vec![member] },
        "files": if accepted { 1.0 } else { 0.0 },
    }})
}

fn write(path: &Path, lines: &[Value]) {
    let head = json!({"format": "phase-attempt-times/1"});
    let lines: Vec<String> = core::iter::once(&head).chain(lines).map(Value::to_string).collect();
    fs::write(path.join("times.jsonl"), lines.join("\n")).expect("written");
}

#[test]
fn attempts_ahead_shorten_what_follows_one_another() {
    let folder = tempfile::tempdir().expect("a folder");
    // A slot with five refused attempts of 2 s, then one of 2 s, its comparison and its files.
    let mut lines: Vec<Value> = (0..5).map(|number| attempt(0, number, 2.0, false)).collect();
    lines.extend([attempt(0, 5, 2.0, true), json!({"completing": 3.0})]);
    write(folder.path(), &lines);
    let output = run(folder.path(), &["check-schedule", "times.jsonl", "--cores", "1,2,32", "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let value: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!((&value["cpu_seconds"], &value["attempts"]), (&json!(18.0), &json!(6)));
    let seconds = |row: usize, field: &str| value["runs"][row][field].as_f64().expect("a number");
    for row in 0..3 {
        assert!((seconds(row, "in_sequence_seconds") - 18.0).abs() < 1e-9, "one slot has one thread");
    }
    assert!((seconds(0, "ahead_seconds") - 18.0).abs() < 1e-9 && seconds(0, "in_vain").abs() < 1e-9);
    assert!((9.0..18.0).contains(&seconds(1, "ahead_seconds")), "{value}");
    // All at once: an event and its comparison side by side, the files, the rest.
    assert!((seconds(2, "ahead_seconds") - 6.0).abs() < 1e-9, "{value}");
    assert!(seconds(2, "in_vain") > 0.0);
}

#[test]
fn interrupted_runs_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path(), &[attempt(0, 0, 1.0, true), attempt(7, 1, 1.0, true)]);
    let sentence = refuse(folder.path(), &["check-schedule", "times.jsonl"]);
    assert!(sentence.contains("times.jsonl") && sentence.contains("slot 7"), "{sentence}");
    fs::write(folder.path().join("times.jsonl"), "{}").expect("written");
    assert!(refuse(folder.path(), &["check-schedule", "times.jsonl"]).contains("attempt times"));
}
