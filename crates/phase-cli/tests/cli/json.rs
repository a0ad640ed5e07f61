//! `--json`: one JSON object on stdout, and nothing else there.

use crate::{
    eval::events_of,
    support::{QUICK, run, succeed, text},
};
use serde_json::Value;
use std::{fs, path::Path};

fn object(path: &Path, arguments: &[&str]) -> Value {
    let told = succeed(path, arguments);
    let value: Value =
        serde_json::from_str(&told).unwrap_or_else(|error| panic!("{arguments:?}: {error}: {told}"));
    assert!(value.is_object(), "{arguments:?}: {told}");
    value
}

#[test]
fn every_command_that_reports_can_do_it_in_json() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    let generate = [&["gen-dataset", "--events", "2", "--out", "set", "--json"], &QUICK[..]].concat();
    let made = object(path, &generate);
    assert_eq!(
        (&made["events"], &made["new"], &made["page"]),
        (&2.into(), &true.into(), &"set/index.html".into())
    );
    let again = object(path, &generate);
    assert_eq!((&again["events"], &again["new"]), (&2.into(), &false.into()));
    for k in ["1", "2"] {
        let (shard, out) = (format!("{k}/2"), format!("shard{k}"));
        let shard =
            [&["gen-dataset", "--events", "2", "--json", "--shard", &shard, "--out", &out], &QUICK[..]];
        assert_eq!(object(path, &shard.concat())["of"], 2);
    }
    assert_eq!(object(path, &["merge", "shard1", "shard2", "--out", "merged", "--json"])["events"], 2);
    assert_eq!(object(path, &["verify", "set", "--json"])["problems"], Value::Array(Vec::new()));
    let stats = object(path, &["stats", "set", "--json"]);
    assert_eq!((&stats["events"], &stats["figures"][0]["here"]), (&2.into(), &"2".into()));
    let rendered = object(path, &["render", "set", "--contact-sheet", "2", "--out", "sheets", "--json"]);
    assert_eq!(rendered["files"][1]["file"], "sheets/demo-0001.png");
    assert_eq!(rendered["files"][1]["interpolated"], false);
    let simulate = ["simulate", "--events", "set", "--no-video", "--out", "again", "--json"];
    let simulated = object(path, &[&simulate[..], &QUICK[..]].concat());
    assert_eq!((&simulated["events"][0]["id"], &simulated["recorded"]), (&"demo-0000".into(), &true.into()));
    let evaluated =
        object(path, &["eval", "goals", "--method", "chance", "--events", "events.json", "--json"]);
    assert_eq!((&evaluated["method"], &evaluated["run"]["n_events"]), (&"chance".into(), &6.into()));
    // What it left in its folder is the same.
    let left = fs::read(path.join("out/eval/goals-chance-events/results.json")).expect("results");
    assert_eq!(evaluated, serde_json::from_slice::<Value>(&left).expect("JSON"));
}

#[test]
fn a_result_that_is_a_failure_is_printed_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    succeed(path, &[&["gen-dataset", "--events", "1", "--no-video", "--out", "set"], &QUICK[..]].concat());
    fs::write(path.join("set/notes.txt"), "mine").expect("written");
    let output = run(path, &["verify", "set", "--json"]);
    assert_eq!(output.status.code(), Some(2));
    let value: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(value["problems"][0], "set/notes.txt: is not in the manifest", "{value}");
    assert!(text(&output.stderr).ends_with("error: set: 1 problem(s)\n"));
    let output = run(path, &["splits", "set", "--make", "split.json", "--json"]);
    let value: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let broken = value["rules"].as_array().expect("rules").iter().any(|rule| rule["met"] == false);
    assert_eq!(broken, output.status.code() == Some(2), "{value}");
}
