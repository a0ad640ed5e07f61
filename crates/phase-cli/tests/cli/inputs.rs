//! Inputs stay as they are, whatever a file of results is named, and are what they say.

use crate::support::{fail, recording, refuse, run, succeed, text, tree, write_events};
use serde_json::{Value, json};
use std::{fs, path::Path};

/// Six events of eight steps, with videos if asked for.
fn generate(path: &Path, out: &str, seed: &str, videos: bool) {
    let effort = ["--max-steps", "8", "--simulations", "10", "--particles", "4"];
    let form = if videos { ["--size", "64"].as_slice() } else { &["--no-video"] };
    let made = ["gen-dataset", "--events", "6", "--seed", seed, "--out", out];
    succeed(path, &[&made[..], &effort, form].concat());
}

#[test]
fn no_output_replaces_an_input() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "data", "1", false);
    write_events(&path.join("in.json"), &[recording("one"), recording("two")]);
    fs::write(path.join("t.csv"), "time,body,x,y\n0,a,1,1\n").expect("written");
    let before = tree(path);
    let eval = ["eval", "goals", "--method", "chance", "--out", "scores", "--events"];
    let cases: &[&[&str]] = &[
        &["in.json", "--json", "in.json"],
        &["in.json", "--json", "./in.json"],
        &["data", "--json", "data/manifest.json"],
        &["data", "--json", "data/new.json"],
    ];
    for &case in cases {
        let told = refuse(path, &[&eval[..], case].concat());
        assert!(told.contains("--json") && told.contains("is an input file or in an input folder"), "{told}");
    }
    for case in [
        &["aoi", "in.json", "--out", "in.json"][..],
        &["aoi", "data", "--out", "data/areas.csv"],
        &["splits", "in.json", "--make", "in.json"],
        &["splits", "data", "--make", "data/manifest.json"],
        &["track", "t.csv", "--out", "t.csv"],
        &["benchmark", "--data", "data", "--methods", "chance", "--figures", "data/manifest.json"],
    ] {
        let told = refuse(path, case);
        assert!(told.contains("is an input file or in an input folder"), "{case:?}: {told}");
    }
    assert_eq!(tree(path), before, "nothing was written");
}

#[test]
fn a_place_that_cannot_be_written_is_refused_before_the_work() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    write_events(&path.join("in.json"), &[recording("one")]);
    fs::create_dir(path.join("there")).expect("a folder");
    for (out, rule) in [("nowhere/a.csv", "its folder does not exist"), ("there", "is a folder")] {
        let told = refuse(path, &["aoi", "in.json", "--out", out]);
        assert!(told.contains(rule), "{told}");
    }
    let told = refuse(path, &["clip", "in.json", "--seconds", "1", "--size", "65", "--out", "clips"]);
    assert!(told.contains("--size: must be even for videos, not 65"), "{told}");
}

#[test]
fn names_of_clips_are_names_of_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    write_events(&path.join("in.json"), &[recording("one"), recording("two")]);
    succeed(path, &["clip", "in.json", "--seconds", "1", "--size", "64", "--out", "clips"]);
    let file = path.join("clips/clips.json");
    let list: Value = serde_json::from_slice(&fs::read(&file).expect("a list")).expect("JSON");
    let other = list["clips"][1]["id"].as_str().expect("a name").to_owned();
    for (id, rule) in [("../../evil", "clips: id must be"), ("", "clips: id must be"), (&other, "two clips")]
    {
        let mut wrong = list.clone();
        wrong["clips"][0]["id"] = json!(id);
        fs::write(&file, wrong.to_string()).expect("written");
        let told = fail(path, &["pack", "clips", "--for", "psychopy", "--out", "packed"]);
        assert!(told.contains("clips.json") && told.contains(rule), "{id:?}: {told}");
        assert!(!path.join("packed").exists(), "{id:?}");
    }
}

#[test]
fn questions_are_sealed_with_the_events_that_they_are_about() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "one", "11259375999999999999", false);
    generate(path, "other", "11259375999999999998", false);
    let asked = run(path, &["questions", "other", "--no-video", "--out", "asked"]);
    if !asked.status.success() {
        assert!(text(&asked.stderr).contains("no question can be asked"), "{}", text(&asked.stderr));
        // Questions of another program, about the same names.
        fs::create_dir_all(path.join("asked")).expect("a folder");
        fs::write(path.join("asked/questions.jsonl"), "").expect("written");
        fs::write(path.join("asked/questions.json"), json!({ "run": { "events": ["x"] } }).to_string())
            .expect("written");
    }
    let told = fail(path, &["seal", "one", "--questions", "asked", "--out", "public"]);
    assert!(told.contains("questions.json: is not about the events of one"), "{told}");
}

#[test]
fn a_part_of_events_that_are_not_divided_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "data", "1", false);
    let told = fail(path, &["questions", "data", "--split", "test", "--no-video", "--out", "asked"]);
    assert!(told.contains("data: has no test events: it is not divided"), "{told}");
}

/// The legend of the picture is as wide as the arena.
#[test]
fn beliefs_are_drawn_at_the_smallest_size() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "data", "1", false);
    let render =
        ["render", "data", "--id", "demo-0000", "--belief", "0", "--size", "64", "--out", "small.mp4"];
    succeed(path, &render);
    assert!(path.join("small.mp4").is_file());
}
