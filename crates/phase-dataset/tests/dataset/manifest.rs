//! Manifests describe a dataset and detect changes.

use crate::support::plain_event;
use phase_dataset::{
    form::StimulusForm,
    manifest::{DATASET_FORMAT, EventEntry, MANIFEST_FILE, Manifest, event_path, video_path},
};
use phase_files::Problem;
use phase_model::{EventKind, Relation, json::JsonError};
use serde_json::{Value, json};
use std::{fs, path::Path};

/// A dataset of one event whose files hold a few bytes.
pub(crate) fn dataset(folder: &Path, id: &str) -> Manifest {
    for path in [event_path(id), video_path(id)] {
        fs::create_dir_all(folder.join(&path).parent().expect("a parent")).expect("a folder");
        fs::write(folder.join(&path), path.as_bytes()).expect("written");
    }
    let entry = EventEntry::of(folder, id, &plain_event(2), true).expect("described");
    Manifest {
        format: DATASET_FORMAT.into(),
        generator: "phase test".into(),
        preset: "demo".into(),
        seed: u64::MAX,
        date_published: None,
        settings: json!({"max_steps": 2}),
        form: StimulusForm::default(),
        selection: Vec::new(),
        sets: Vec::new(),
        events: vec![entry],
        files: vec![],
    }
}

#[test]
fn an_event_is_described_as_it_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let manifest = dataset(folder.path(), "demo-0000");
    let event = &manifest.events[0];
    assert_eq!((event.kind, event.relation, event.steps), (EventKind::Helping, Relation::Friendly, 2));
    assert_eq!((event.layout.base, event.layout.flip), (20, Some(3)));
    assert_eq!(
        event.agents.map(|agent| (agent.size_level, agent.strength_level, agent.alpha)),
        [(3, 2, 1), (3, 2, 0)]
    );
    assert_eq!(event.object_size_levels, [0, 2]);
    let video = event.video.as_ref().expect("a video");
    assert_eq!(video.path.as_str(), "videos/demo-0000.mp4");
    assert_eq!(video.bytes, "videos/demo-0000.mp4".len() as u64);
}

#[test]
fn a_manifest_is_read_as_it_was_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let manifest = dataset(folder.path(), "demo-0000");
    let path = folder.path().join(MANIFEST_FILE);
    manifest.write(folder.path()).expect("written");
    let read = Manifest::read(&path).expect("our own manifest");
    assert_eq!(read, manifest);
    read.verify(folder.path()).expect("unchanged");
    fs::write(folder.path().join(video_path("demo-0000")), "another").expect("written");
    let error = read.verify(folder.path()).expect_err("changed");
    assert!(error.file.ends_with(video_path("demo-0000")), "{error}");
}

#[test]
fn what_is_no_manifest_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let good: Value = serde_json::to_value(dataset(folder.path(), "a")).expect("JSON");
    let path = folder.path().join(MANIFEST_FILE);
    let read = |text: &str| {
        fs::write(&path, text).expect("written");
        Manifest::read(&path).expect_err(text).problem
    };
    assert!(matches!(read("{}"), Problem::Json(JsonError::Format { .. })));
    assert!(matches!(read("{\"format\":\"other\"}"), Problem::Json(JsonError::Format { .. })));
    let mut value = good.clone();
    value.as_object_mut().expect("an object").remove("seed");
    let problem = read(&value.to_string());
    assert!(problem.to_string().contains("seed"), "{problem}");
    for (pointer, name, rule) in [
        ("/events/0/event/path", "/etc/passwd", "the path \"/etc/passwd\" must be a relative path"),
        ("/events/0/video/path", "../a", "the path \"../a\" must be a relative path"),
        ("/events/0/id", "../../a", "the id \"../../a\" must be 1 to 100 letters"),
        ("/events/0/id", "nul", "the id \"nul\" must not have a name that is a device's"),
    ] {
        let mut value = good.clone();
        *value.pointer_mut(pointer).expect("a member") = name.into();
        let problem = read(&value.to_string());
        assert!(problem.to_string().contains(rule), "{problem}");
    }
    let text = good.to_string();
    assert!(matches!(read(&text[..text.len() - 9]), Problem::Json(JsonError::Truncated(_))));
}
