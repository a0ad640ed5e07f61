//! `fit-inference` on events of a few steps, with minds that search little.

use crate::support::{recording, refuse, run, succeed, text, write_events};
use serde_json::Value;
use std::{fs, path::Path};

const FIT: [&str; 7] = ["fit-inference", "--events", "events.json", "--simulations", "4", "--folds", "2"];

fn fit<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&FIT[..], more].concat()
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    write_events(&folder.path().join("events.json"), &[recording("a"), recording("b")]);
    write_events(&folder.path().join("others.json"), &[recording("c")]);
    folder
}

fn json_of(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).expect("a file")).expect("JSON")
}

#[test]
fn a_fit_to_both_kinds_goes_on_where_it_was() {
    let folder = folder();
    let path = folder.path();
    let options = ["--held-out", "others.json", "--out", "weights.json"];
    let table = succeed(path, &fit(&options));
    for row in ["without fold 1, on it", "held out, all folds", "fitted to all, on them", "others.json"] {
        assert!(table.contains(row), "{row}: {table}");
    }
    let weights = json_of(&path.join("weights.json"));
    assert_eq!(weights["lapse_rates"].as_array().map(Vec::len), Some(2), "{weights}");

    // As if it had been killed in the middle of the last line: the other events are not simulated again.
    let kept = path.join("weights.evaluations.jsonl");
    let text = fs::read_to_string(&kept).expect("evidence");
    assert_eq!(text.lines().count(), 3);
    fs::write(&kept, &text[..text.len() - 9]).expect("written");
    assert_eq!(succeed(path, &fit(&options)), table);
    let after = fs::read_to_string(&kept).expect("evidence");
    assert_eq!(after.lines().count(), 4, "one line cut off, and one event simulated again");
    assert_eq!(after.lines().last(), text.lines().last());
}

#[test]
fn one_kind_has_one_lapse_rate_and_other_numbers() {
    let folder = folder();
    let path = folder.path();
    let table = |minds| succeed(path, &fit(&["--minds", minds, "--out", "one.json"]));
    assert_ne!(table("phase"), table("published"));
    assert_eq!(json_of(&path.join("one.json"))["lapse_rates"].as_array().map(Vec::len), Some(1));
}

#[test]
fn what_cannot_be_fitted_is_refused() {
    let folder = folder();
    let path = folder.path();
    let few = refuse(path, &["fit-inference", "--events", "others.json"]);
    assert!(few.contains("1 event, fewer than --folds 5"), "{few}");
    let both = run(path, &fit(&["--minds", "phase", "--parameters", "p.json"]));
    assert_eq!(both.status.code(), Some(2));
    assert!(text(&both.stderr).contains("cannot be used with"), "{}", text(&both.stderr));
}
