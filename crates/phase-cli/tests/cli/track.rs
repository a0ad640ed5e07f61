//! `track`: several inputs at once.

use crate::support::{phase, recording, refuse, run, succeed, text, write_events};
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

/// One changed byte in the boxes of a video neither stops the program nor keeps it busy for ever.
#[test]
fn damaged_videos_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    write_events(&folder.join("in.json"), &[recording("one")]);
    succeed(folder, &["render", "in.json", "--size", "480", "--out", "good.mp4", "--quiet"]);
    succeed(folder, &["track", "good.mp4", "--quiet", "--out", "good.json"]);
    let good = fs::read(folder.join("good.mp4")).expect("a video");
    let place = |name: &[u8]| good.windows(4).position(|it| it == name).expect("a box");
    // Sizes of boxes, lengths and numbers of entries.
    let changes = [
        (place(b"tkhd") - 1, 0),
        (place(b"mdhd") - 1, 1),
        (place(b"moov") - 2, 255),
        (place(b"avcC") + 10, 255),
        (place(b"stsc") + 8, 1),
        (place(b"stsc") + 11, 0),
        (place(b"stsz") + 12, 255),
        (place(b"stsz") + 8, 1),
        (place(b"stts") + 11, 0),
        (place(b"stco") + 11, 0),
    ];
    for (k, (place, byte)) in changes.into_iter().enumerate() {
        let mut damaged = good.clone();
        assert_ne!(damaged[place], byte, "change {k}");
        damaged[place] = byte;
        fs::write(folder.join("bad.mp4"), damaged).expect("written");
        // Without ffmpeg, which may make something of it.
        let mut track = phase(folder);
        let output =
            track.args(["track", "bad.mp4", "--quiet", "--out", "bad.json"]).env("PATH", "").output();
        let output = output.expect("the program starts");
        let told = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "change {k}: {told}");
        assert!(told.contains("bad.mp4: is no video that can be read here"), "change {k}: {told}");
    }
}
