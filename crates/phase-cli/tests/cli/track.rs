//! `track`: several inputs at once.

use crate::support::{refuse, run, succeed, text};
use serde_json::Value;
use std::fs;

const WALK: &str = "time,body,x,y\n0,red,8,8\n1,red,12,8\n0,green,20,20\n1,green,20,20\n";

#[test]
fn what_is_refused_takes_nothing_away_from_the_others() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    for (name, content) in [("a.csv", WALK), ("b.csv", "time,body\n0,red\n"), ("c.csv", WALK)] {
        fs::write(folder.join(name), content).expect("written");
    }
    fs::write(folder.join("d.mp4"), "no video").expect("written");
    let inputs = ["track", "a.csv", "b.csv", "c.csv", "d.mp4", "--out", "events.json"];
    let output = run(folder, &[&inputs[..], &["--quiet"]].concat());
    let told = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.starts_with("error: 2 of 4 inputs were refused:\n"), "{told}");
    assert!(told.contains("\n  b.csv: ") && told.contains("\n  d.mp4: "), "{told}");
    let events: Value =
        serde_json::from_slice(&fs::read(folder.join("events.json")).expect("events")).expect("JSON");
    let ids: Vec<&Value> = events["events"].as_array().expect("events").iter().map(|it| &it["id"]).collect();
    assert_eq!(ids, ["a", "c"]);
    // The order of results is that of inputs, for any number of threads.
    let one = succeed(folder, &["track", "c.csv", "a.csv", "--jobs", "1", "--quiet", "--out", "one.json"]);
    let many = succeed(folder, &["track", "c.csv", "a.csv", "--jobs", "7", "--quiet", "--out", "many.json"]);
    assert_eq!(one.replace("one.json", "many.json"), many);
    assert_eq!(fs::read(folder.join("one.json")).ok(), fs::read(folder.join("many.json")).ok());
    // Nothing is written where nothing could be read, nor under one name twice.
    refuse(folder, &["track", "b.csv", "--quiet", "--out", "none.json"]);
    fs::create_dir(folder.join("e")).expect("a folder");
    fs::write(folder.join("e/A.csv"), WALK).expect("written");
    refuse(folder, &["track", "a.csv", "e/A.csv", "--quiet", "--out", "none.json"]);
    assert!(!folder.join("none.json").exists());
}

#[test]
fn options_that_say_nothing_about_an_input_are_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    fs::write(folder.join("a.csv"), WALK).expect("written");
    fs::write(folder.join("b.mp4"), "no video").expect("written");
    let cases: [(&str, &[&str], &str); 7] = [
        ("a.csv", &["--map", "1,2"], "--map: is about videos and pictures"),
        ("a.csv", &["--frames", "rows"], "--frames: is about videos and pictures"),
        ("a.csv", &["--frame-rate", "30"], "--frame-rate: is about folders of pictures"),
        ("a.csv", &["--shapes", "shapes.csv"], "--shapes: needs one video"),
        ("b.mp4", &["--sizes", "1"], "--sizes: is about tables"),
        ("b.mp4", &["--map", "1,1"], "gives body 1 two roles"),
        ("a.csv", &["--columns", "time,body,x,x"], "names the column \"x\" twice"),
    ];
    for (input, options, rule) in cases {
        let output = run(folder, &[&["track", input, "--quiet", "--out", "out.json"], options].concat());
        let told = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{options:?}: {told}");
        assert!(told.contains(rule), "{options:?}: {told}");
        assert!(!folder.join("out.json").exists(), "{options:?}");
    }
}
