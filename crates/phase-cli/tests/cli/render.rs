//! `render`: from events to pictures.

use crate::support::{QUICK, recording, refuse, succeed, tree, write_events};
use serde_json::Value;
use std::{fs, path::Path};

fn names(folder: &Path) -> Vec<String> {
    tree(folder).keys().map(|name| name.display().to_string()).collect()
}

#[test]
fn recordings_become_videos_and_pictures() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    write_events(&path.join("events.json"), &[recording("a"), recording("b")]);
    let told = succeed(path, &["render", "events.json", "--out", "videos"]);
    assert!(told.contains("interpolated"), "{told}");
    assert_eq!(names(&path.join("videos")), ["a.mp4", "b.mp4"]);
    succeed(path, &["render", "events.json", "--id", "b", "--out", "b.mp4"]);
    assert_eq!(&fs::read(path.join("b.mp4")).expect("a video")[4..8], b"ftyp");
    succeed(path, &["render", "events.json", "--id", "a", "--contact-sheet", "6", "--out", "a.png"]);
    let png = fs::read(path.join("a.png")).expect("a picture");
    // Three columns and two rows of 320 pixels, 4 apart.
    assert_eq!(png_size(&png), (3 * 324 + 4, 2 * 324 + 4));
    let accessible = ["--palette", "accessible", "--contact-sheet", "6", "--out", "b.png"];
    succeed(path, &[&["render", "events.json", "--id", "a"], &accessible[..]].concat());
    let other = fs::read(path.join("b.png")).expect("a picture");
    assert_eq!(png_size(&other), png_size(&png));
    assert_ne!(other, png, "other colours");
}

/// Width and height of a .png (pixels).
fn png_size(png: &[u8]) -> (u32, u32) {
    let size = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().expect("four bytes"));
    assert_eq!(&png[1..4], b"PNG");
    (size(16), size(20))
}

#[test]
fn datasets_are_rendered_as_they_were_made() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    succeed(path, &[&["gen-dataset", "--events", "2", "--out", "set"], &QUICK[..]].concat());
    succeed(path, &["render", "set", "--out", "again"]);
    let mut set = tree(&path.join("set/videos"));
    set.remove(Path::new("metadata.csv"));
    assert!(tree(&path.join("again")) == set, "an event file holds all that its video shows");
    let told = succeed(path, &["render", "set", "--id", "demo-0001", "--belief", "1", "--out", "minds"]);
    assert!(told.ends_with("open minds/index.html to watch them\n"), "{told}");
    assert_eq!(names(&path.join("minds")), ["demo-0001.belief1.mp4", "index.html"]);
    let page = fs::read_to_string(path.join("minds/index.html")).expect("a page");
    assert!(page.contains("data-src=\"demo-0001.belief1.mp4\"") && !page.contains("demo-0000"));
    assert!(!page.contains("href=\"events"), "no file of the dataset lies beside it");
    let mind = fs::read(path.join("minds/demo-0001.belief1.mp4")).expect("a video");
    assert!(mind != set[Path::new("demo-0001.mp4")]);

    let sheet = |belief: &str, out: &str| {
        let arguments = ["--id", "demo-0001", "--belief", belief, "--contact-sheet", "1", "--out", out];
        succeed(path, &[&["render", "set"], &arguments[..]].concat());
        png_size(&fs::read(path.join(out)).expect("a picture"))
    };
    let ((one_wide, one_high), (both_wide, both_high)) = (sheet("0", "one.png"), sheet("both", "both.png"));
    // Around a single frame there are 4 pixels, and as many between the two views.
    assert_eq!((both_wide - 8, both_high), (2 * (one_wide - 8) + 4, one_high));
    let video = |jobs: &str, out: &str| {
        succeed(path, &["render", "set", "--belief", "both", "--jobs", jobs, "--out", out]);
        tree(&path.join(out))
    };
    // A file cannot make it fill the memory.
    let longer =
        ["--events", "1", "--no-video", "--simulations", "5", "--particles", "2", "--max-steps", "6"];
    succeed(path, &[&["gen-dataset", "--out", "longer"], &longer[..]].concat());
    let file = path.join("longer/events/demo-0000.json");
    let mut document: Value = serde_json::from_slice(&fs::read(file).expect("an event")).expect("JSON");
    document["events"][0]["settings"]["minds"]["particles"] = 100_000.into();
    fs::write(path.join("many.json"), document.to_string()).expect("written");
    let refused = refuse(path, &["render", "many.json", "--quiet", "--belief", "both", "--out", "many"]);
    assert!(refused.contains("at most 1000000 states"), "{refused}");
    let (alone, together) = (video("1", "alone"), video("2", "together"));
    let both = ["demo-0000.belief-both.mp4", "demo-0001.belief-both.mp4", "index.html"];
    assert_eq!(names(&path.join("alone")), both);
    // In the folder of a dataset, its own page stays.
    let before = fs::read(path.join("set/index.html")).expect("a page");
    succeed(path, &["render", "set", "--id", "demo-0000", "--belief", "0", "--out", "set"]);
    assert!(fs::read(path.join("set/index.html")).expect("a page") == before);
    assert!(alone == together, "the number of threads changes nothing");
}

#[test]
fn an_observer_is_drawn_below_and_written_beside() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    write_events(&path.join("events.json"), &[recording("a")]);
    let told = succeed(path, &["render", "events.json", "--observer", "--out", "watched"]);
    assert!(told.contains("ms a step"), "{told}");
    assert_eq!(names(&path.join("watched")), ["a.observer.json", "a.observer.mp4"]);
    let course = |file: &str| -> serde_json::Value {
        let bytes = fs::read(path.join(file)).expect("a course");
        let mut course: serde_json::Value = serde_json::from_slice(&bytes).expect("JSON");
        let steps = course["course"].as_array_mut().expect("steps");
        for (step, said) in steps.iter_mut().enumerate() {
            assert!((said["seconds"].as_f64().expect("seconds") - 0.25 * step as f64).abs() < 1e-9);
            let relation = said["relation"].as_object().expect("probabilities").values();
            let sum: f64 = relation.map(|p| p.as_f64().expect("a number")).sum();
            assert!((sum - 1.0).abs() < 1e-9, "{said}");
            // The time that a step took is measured.
            said.as_object_mut().expect("an object").remove("took");
        }
        course
    };
    let first = course("watched/a.observer.json");
    assert_eq!(first["format"], "phase-observer/1");
    succeed(path, &["render", "events.json", "--observer", "--out", "again.mp4"]);
    assert_eq!(course("again.observer.json"), first);
    let sheet = ["--observer", "--contact-sheet", "1", "--out", "sheet.png"];
    succeed(path, &[&["render", "events.json"], &sheet[..]].concat());
    let (wide, high) = png_size(&fs::read(path.join("sheet.png")).expect("a picture"));
    assert!(high > wide, "text and the course are below");
}
