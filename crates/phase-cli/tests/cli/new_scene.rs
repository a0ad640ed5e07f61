//! `new-scene`, and scenes that differ in one thing.

use crate::support::{QUICK, recording, refuse, succeed, tree, write_events};
use phase_dataset::phase_events;
use phase_model::{EventKind, Layout};
use serde_json::Value;
use std::{fs, path::Path};

fn simulated(path: &Path, file: &str, out: &str, more: &[&str]) -> String {
    let options = ["simulate", "--events", file, "--out", out];
    succeed(path, &[&options[..], &QUICK[..], more].concat())
}

#[test]
fn a_new_scene_simulates_as_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    for kind in EventKind::ALL {
        let file = format!("{}.json", kind.name());
        let told = succeed(path, &["new-scene", "--kind", kind.name(), "--out", &file]);
        assert!(told.contains(&format!("phase simulate --events {file}")), "{told}");
        let scene = phase_events::read(&path.join(&file)).expect("a scene").remove(0).scene;
        assert_eq!((scene.kind, scene.validate_without_overlap()), (kind, Ok(())));
        let text = fs::read_to_string(path.join(&file)).expect("text");
        assert!(text.contains("\"_comment\"") && text.contains("docs/reference/formats/events.md"), "{text}");
        let told = simulated(path, &file, &format!("out/{}", kind.name()), &["--no-video"]);
        assert!(told.contains(&format!("| {0} | {0} |", kind.name())), "{told}");
    }
    succeed(path, &["new-scene", "--layout", "7", "--out", "seven.json", "--seed", "5"]);
    let scene = phase_events::read(&path.join("seven.json")).expect("a scene").remove(0).scene;
    assert_eq!(Ok(scene.layout), Layout::new(7, None));
    let before = fs::read(path.join("seven.json")).expect("a file");
    assert!(refuse(path, &["new-scene", "--out", "seven.json"]).contains("seven.json exists"));
    assert_eq!(fs::read(path.join("seven.json")).expect("a file"), before);
}

#[test]
fn scenes_have_a_page_to_watch_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    succeed(path, &["new-scene", "--kind", "chasing"]);
    let told = simulated(path, "scene.json", "out", &[]);
    assert!(told.ends_with("open out/index.html to watch them\n"), "{told}");
    let page = fs::read_to_string(path.join("out/index.html")).expect("a page");
    assert!(page.contains("data-src=\"chasing.mp4\"") && page.contains("href=\"chasing.json\""), "{page}");
}

/// The seeds of the two simulated events.
fn seeds(path: &Path, out: &str) -> Vec<Value> {
    let of = |id: &str| {
        let text = fs::read(path.join(out).join(id)).expect("an event");
        serde_json::from_slice::<Value>(&text).expect("JSON")["events"][0]["seed"].clone()
    };
    vec![of("first.json"), of("second.json")]
}

#[test]
fn same_chance_gives_every_scene_the_same_random_numbers() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    // Identical except for their ids.
    write_events(&path.join("events.json"), &[recording("first"), recording("second")]);
    simulated(path, "events.json", "apart", &["--no-video"]);
    simulated(path, "events.json", "same", &["--no-video", "--same-chance"]);
    let (apart, same) = (seeds(path, "apart"), seeds(path, "same"));
    assert_ne!(apart[0], apart[1]);
    assert_eq!(same[0], same[1]);
    let rows = |out: &str, id: &str| {
        phase_events::read(&path.join(out).join(id)).expect("an event").remove(0).trajectory
    };
    assert_eq!(rows("same", "first.json"), rows("same", "second.json"));
    assert_ne!(rows("apart", "first.json"), rows("apart", "second.json"));
    // Each is distinguished from a run without.
    let options = ["simulate", "--events", "events.json", "--no-video", "--out", "apart", "--same-chance"];
    assert!(refuse(path, &[&options[..], &QUICK[..]].concat()).contains("same_chance"));
}

#[test]
fn folders_of_events_are_taken_like_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    write_events(&path.join("events.json"), &[recording("first"), recording("second")]);
    simulated(path, "events.json", "from-file", &["--no-video"]);
    // Its events start as those of the file do, so all but what they are compared with is the same.
    simulated(path, "from-file", "from-folder", &["--no-video"]);
    let (file, folder) = (tree(&path.join("from-file")), tree(&path.join("from-folder")));
    for id in ["first.json", "second.json"] {
        assert!(file[Path::new(id)] == folder[Path::new(id)], "{id}");
    }
    simulated(path, "from-file", "second-alone", &["--no-video", "--id", "second"]);
    assert!(tree(&path.join("second-alone"))[Path::new("second.json")] == file[Path::new("second.json")]);
    succeed(path, &["eval", "goals", "--method", "cue", "--events", "from-file"]);
    for events in ["events.json", "from-file"] {
        let figures = succeed(path, &["stats", events]);
        assert!(
            figures.contains("| videos | 500 | 2 |") && figures.contains("| independent | 2 |"),
            "{figures}"
        );
    }
}

#[test]
fn a_start_alone_is_no_event_to_evaluate() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let mut start = recording("start");
    for pointer in ["/trajectory/agents/0", "/trajectory/agents/1", "/trajectory/objects/0"] {
        start.pointer_mut(pointer).and_then(Value::as_array_mut).expect("rows").truncate(1);
    }
    write_events(&path.join("events.json"), &[recording("whole"), start]);
    let sentence = refuse(path, &["eval", "goals", "--method", "cue", "--events", "events.json"]);
    assert!(sentence.contains("events.json: event start has only one row"), "{sentence}");
    assert!(!path.join("out").exists());
}
