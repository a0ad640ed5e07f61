//! `render`: what becomes of events on their way to pictures.

use crate::support::{QUICK, recording, succeed, tree, write_events};
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
    let size = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().expect("four bytes"));
    assert_eq!(&png[1..4], b"PNG");
    // Three columns and two rows of 320 pixels, 4 apart.
    assert_eq!((size(16), size(20)), (3 * 324 + 4, 2 * 324 + 4));
}

#[test]
fn datasets_are_rendered_as_they_were_made() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    succeed(path, &[&["gen-dataset", "--events", "2", "--out", "set"], &QUICK[..]].concat());
    succeed(path, &["render", "set", "--out", "again"]);
    let set = tree(&path.join("set/videos"));
    assert!(tree(&path.join("again")) == set, "an event file holds all that its video shows");
    succeed(path, &["render", "set", "--id", "demo-0001", "--belief", "1", "--out", "minds"]);
    assert_eq!(names(&path.join("minds")), ["demo-0001.belief1.mp4"]);
    let mind = fs::read(path.join("minds/demo-0001.belief1.mp4")).expect("a video");
    assert!(mind != set[Path::new("demo-0001.mp4")]);
}
