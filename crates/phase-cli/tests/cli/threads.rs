//! Threads and kills leave no trace in a dataset.
#![cfg(unix)]

use crate::support::{phase, succeed, tree};
use std::{
    fs,
    io::{BufRead, BufReader},
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

/// Fewer slots than threads, of agents that search little: the first scenes often fail, before and after the
/// comparison with an idle agent.
const EVENTS: &str = r#"{
  "format": "phase-preset/3", "name": "events", "seed": 3,
  "layouts": {"open": [0, 2, 6]},
  "selection": {"min_steps": 40, "max_steps": 60, "attempts": 200, "ends": "drawn"},
  "groups": [
    {"variant": "lift", "layouts": "open", "events": 1},
    {"variant": "compete", "layouts": "open", "events": 1},
    {"variant": "drag", "layouts": "open", "events": 1}
  ]
}"#;

/// Slots whose attempts share stages.
const BLOCKS: &str = r#"{
  "format": "phase-preset/3", "name": "blocks", "seed": 5,
  "layouts": {"some": [0, 2, 6]},
  "selection": {"min_steps": 40, "max_steps": 60, "attempts": 400, "ends": "drawn"},
  "blocks": {
    "columns": [["drag"], ["chase"], ["mixed"]],
    "groups": [{"split": "train", "layouts": "some", "blocks": 1}]
  }
}"#;

/// Slots whose attempts consist of several events.
const SETS: &str = r#"{
  "format": "phase-preset/3", "name": "sets", "seed": 5,
  "layouts": {"some": [0, 2, 6]},
  "selection": {"min_steps": 40, "max_steps": 50, "attempts": 400, "ends": "drawn"},
  "sets": [
    {"stances": ["hinder", "indifferent"], "about": "place", "layouts": "some", "sets": 2}
  ]
}"#;

fn generate<'a>(out: &'a str, jobs: &'a str) -> Vec<&'a str> {
    let options =
        ["gen-dataset", "--preset", "preset.json", "--simulations", "20", "--particles", "4", "--no-video"];
    [&options[..], &["--verbose", "--out", out, "--jobs", jobs]].concat()
}

/// Stops a run with four threads after so many of its lines.
fn killed(path: &Path, out: &str, lines: usize) {
    let mut child =
        phase(path).args(generate(out, "4")).stderr(Stdio::piped()).spawn().expect("the program starts");
    let stderr = child.stderr.take().expect("a pipe");
    BufReader::new(stderr).lines().nth(lines);
    Command::new("kill").args(["-KILL", &child.id().to_string()]).status().expect("kill runs");
    child.wait().expect("it ends");
}

/// The records of a killed run: no attempt after one that is missing, and none that one thread would not have
/// made.
fn records(path: &Path) -> Vec<(PathBuf, usize)> {
    let refused = |bytes: &[u8]| {
        let record: serde_json::Value = serde_json::from_slice(bytes).expect("JSON");
        record["refused"].as_array().expect("a list").len()
    };
    let records = tree(path).into_iter().filter(|(name, _)| name.starts_with(".cache"));
    records
        .filter(|(name, _)| !name.to_string_lossy().ends_with(".part"))
        .map(|(name, it)| (name, refused(&it)))
        .collect()
}

fn check(preset: &str) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    fs::write(path.join("preset.json"), preset).expect("written");
    succeed(path, &generate("one", "1"));
    let one = tree(&path.join("one"));
    assert!(one.contains_key(Path::new("manifest.json")));
    succeed(path, &generate("four", "4"));
    assert!(tree(&path.join("four")) == one, "four threads differ from one");
    let total = |out: &str| records(&path.join(out)).iter().map(|(_, refused)| refused).sum::<usize>();
    let all = one[Path::new("manifest.json")].clone();
    let all: serde_json::Value = serde_json::from_slice(&all).expect("JSON");
    let attempts = |row: &serde_json::Value| row["attempts"].as_u64().expect("a number") as usize;
    let all: usize = all["selection"].as_array().expect("rows").iter().map(attempts).sum();
    // Before the first refusal, within attempts, and once an event is finished.
    for lines in [1, 3, 8] {
        let out = format!("killed{lines}");
        killed(path, &out, lines);
        assert!(total(&out) <= all, "attempts that do not count were recorded");
        succeed(path, &generate(&out, if lines == 3 { "1" } else { "3" }));
        assert!(tree(&path.join(&out)) == one, "the run killed after {lines} lines differs");
    }
}

#[test]
fn events_are_the_same_for_any_threads() {
    check(EVENTS);
}

#[test]
fn blocks_are_the_same_for_any_threads() {
    check(BLOCKS);
}

#[test]
fn sets_are_the_same_for_any_threads() {
    check(SETS);
}
