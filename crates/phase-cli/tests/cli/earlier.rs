//! Folders of earlier versions, whose runs cannot be compared, are refused and left alone.

use crate::{
    eval::{events_of, results},
    support::{QUICK, recording, refuse, succeed, tree, write_events},
};
use std::{fs, path::Path};

/// Runs a command in a folder of before, whose name is its last argument.
fn check(path: &Path, arguments: &[&str]) {
    let before = tree(path);
    let sentence = refuse(path, arguments);
    let out = arguments.last().expect("a folder");
    assert!(sentence.contains(&format!("error: {out}: ")), "{sentence}");
    assert!(sentence.contains("earlier version of PHASE") && sentence.contains("--out"), "{sentence}");
    assert!(tree(path) == before, "{arguments:?} has changed something");
}

#[test]
fn an_unfinished_dataset_or_evaluation() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    fs::create_dir_all(path.join("begun/events")).expect("a folder");
    fs::write(
        path.join("begun/.phase-run.json"),
        r#"{"format":"phase-run/1","run":{"command":"gen-dataset"}}"#,
    )
    .expect("written");
    check(path, &["gen-dataset", "--events", "1", "--out", "begun"]);
    check(path, &["eval", "goals", "--method", "chance", "--events", "events.json", "--out", "begun"]);
}

#[test]
fn a_finished_evaluation_or_simulation() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    write_events(&path.join("events.json"), &[recording("a")]);
    let eval = ["eval", "goals", "--method", "chance", "--events", "events.json", "--out", "answers"];
    let simulate =
        [&["simulate", "--events", "events.json"][..], &QUICK, &["--no-video", "--out", "simulated"]]
            .concat();
    for (arguments, file) in [(&eval[..], "answers/results.json"), (&simulate, "simulated/summary.json")] {
        succeed(path, arguments);
        let mut told = results(&path.join(file));
        let run = told["run"].as_object_mut().expect("a run");
        run.remove("format").expect("a format");
        fs::write(path.join(file), format!("{told:#}\n")).expect("written");
        check(path, arguments);
    }
}
