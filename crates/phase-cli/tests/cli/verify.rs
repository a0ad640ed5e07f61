//! `verify`, on a dataset of agents that searched little.

use crate::support::{QUICK, refuse, run, succeed, text};
use std::fs;

#[test]
fn problems_are_told_one_a_line_with_exit_code_2() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    succeed(path, &[&["gen-dataset", "--events", "2", "--out", "out"], &QUICK[..]].concat());
    assert_eq!(succeed(path, &["verify", "out"]), "all 2 events are whole\n");

    fs::remove_file(path.join("out/videos/demo-0001.mp4")).expect("removed");
    fs::write(path.join("out/notes.txt"), "mine").expect("written");
    let output = run(path, &["verify", "out"]);
    assert_eq!(output.status.code(), Some(2));
    let told = text(&output.stderr);
    let lines: Vec<&str> = told.lines().collect();
    assert_eq!(
        lines,
        [
            "verifying 2 events",
            "out/videos/demo-0001.mp4: cannot be read: no such file or directory",
            "out/notes.txt: is not in the manifest",
            "error: out: 2 problem(s)",
        ]
    );
    assert!(output.stdout.is_empty());
    for jobs in ["1", "3"] {
        let again = run(path, &["verify", "out", "--jobs", jobs]);
        assert_eq!((again.status.code(), text(&again.stderr)), (Some(2), told.clone()), "--jobs {jobs}");
    }
}

#[test]
fn what_is_no_finished_dataset_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    assert!(refuse(path, &["verify", "nowhere"]).contains("nowhere: holds no manifest.json"));
    fs::create_dir(path.join("empty")).expect("made");
    assert!(refuse(path, &["verify", "empty"]).contains("empty: holds no manifest.json"));

    fs::create_dir(path.join("begun")).expect("made");
    fs::write(path.join("begun/.phase-run.json"), r#"{"format": "phase-run/1", "run": {}}"#)
        .expect("written");
    assert!(refuse(path, &["verify", "begun"]).contains("begun: is unfinished"));

    fs::create_dir(path.join("cut")).expect("made");
    fs::write(path.join("cut/manifest.json"), "{\"format\":").expect("written");
    assert!(refuse(path, &["verify", "cut"]).contains("cut/manifest.json: is truncated"));
}
