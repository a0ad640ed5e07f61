//! `check-behaviour`, with agents that search little.

use crate::support::{QUICK, recording, refuse, succeed, tree, write_events};
use phase_dataset::phase_events;
use phase_lab::check_behaviour::sets::SceneSet;
use phase_model::Flip;
use serde_json::{Value, json};
use std::{fs, path::Path};

fn check<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["check-behaviour", "--scenes", "scenes"], more, &QUICK[..]].concat()
}

/// A folder with one scene for each of these parts: two agents far apart, and an object.
fn folder(parts: &[&str]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("scenes")).expect("a folder");
    for part in parts {
        write_events(&folder.path().join(format!("scenes/{part}.json")), &[recording("scene")]);
    }
    folder
}

fn report(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).expect("a report")).expect("JSON")
}

#[test]
fn rows_and_seeds_must_be_there() {
    let folder = folder(&[]);
    for (arguments, said) in
        [(["--row", "0"], "--row"), (["--row", "13"], "13"), (["--seeds", "0"], "--seeds")]
    {
        let sentence = refuse(folder.path(), &check(&arguments));
        assert!(sentence.contains(said), "{sentence}");
    }
    let sentence = refuse(folder.path(), &check(&["--row", "1"]));
    assert!(sentence.contains("01-landmark.json"), "{sentence}");
    assert!(!folder.path().join("out").exists(), "nothing is begun that cannot be done");
}

#[test]
fn scenes_that_make_no_sense_are_refused() {
    let folder = folder(&["09-doorway"]);
    let path = folder.path().join("scenes/09-doorway.json");
    let mut mirrored = recording("mirrored");
    mirrored["layout"]["flip"] = json!(1);
    let mut overlapping = recording("overlapping");
    overlapping["trajectory"]["objects"][0] = overlapping["trajectory"]["agents"][1].clone();
    let cases = [(mirrored, "layout.flip"), (overlapping, "overlap"), (json!({"id": 3}), "id")];
    for (event, said) in cases {
        write_events(&path, &[event]);
        let sentence = refuse(folder.path(), &check(&["--row", "9"]));
        assert!(sentence.contains("09-doorway.json") && sentence.contains(said), "{sentence}");
    }
    for rubbish in ["", "{", "rubbish", "[1, 2]", "{\"format\": \"phase-events/1\"}"] {
        fs::write(&path, rubbish).expect("written");
        let sentence = refuse(folder.path(), &check(&["--row", "9"]));
        assert!(sentence.contains("09-doorway.json"), "{sentence}");
    }
}

#[test]
fn a_check_reports_every_event() {
    let folder = folder(&["04-together", "09-doorway"]);
    let path = folder.path();
    let told = succeed(path, &check(&["--row", "4", "9", "--seeds", "3", "--out", "a", "--json", "a.json"]));
    assert!(told.contains("04 carrying together") && told.contains("09 meeting in a doorway"), "{told}");
    let report = report(&path.join("a.json"));
    assert_eq!(report["format"], "phase-behaviour/1");
    let rows = report["rows"].as_array().expect("rows");
    assert_eq!(rows.iter().map(|row| &row["row"]).collect::<Vec<_>>(), [4, 9]);
    for (row, compared) in rows.iter().zip([true, false]) {
        assert_eq!(row["result"]["events"], 3);
        assert_eq!(row["result"]["without"].is_null(), !compared);
        let events = row["scenes"][0]["events"].as_array().expect("events");
        let mirrors: Vec<&Value> = events.iter().map(|event| &event["flip"]).collect();
        assert_eq!(mirrors, [&Value::Null, &json!(0), &json!(1)]);
        // Agent 0 stands on its landmark from the start, agent 1 does not get to its own in four steps.
        assert!(events.iter().all(|event| event["with"] == json!({"reached": true, "steps": 0})));
        assert!(events.iter().all(|event| event["success"] == json!(false)));
    }
    let sheets =
        ["04-together-scene", "04-together-scene-failure", "09-doorway-scene", "09-doorway-scene-failure"];
    for sheet in sheets {
        let bytes = fs::read(path.join(format!("a/sheets/{sheet}.png"))).expect(sheet);
        assert!(bytes.starts_with(b"\x89PNG"), "{sheet}");
    }
}

#[test]
fn a_check_is_repeatable_and_replaces_the_one_before() {
    let folder = folder(&["09-doorway"]);
    let path = folder.path();
    let arguments = |jobs| ["--row", "9", "--seeds", "3", "--out", "out", "--jobs", jobs];
    succeed(path, &check(&arguments("1")));
    let first = tree(&path.join("out"));
    let names: Vec<String> = first.keys().map(|name| name.display().to_string()).collect();
    let sheets = ["sheets/09-doorway-scene-failure.png", "sheets/09-doorway-scene.png"];
    assert_eq!(names, ["behaviour.json", sheets[0], sheets[1]]);
    succeed(path, &check(&arguments("3")));
    assert!(tree(&path.join("out")) == first);
    fs::create_dir(path.join("foreign")).expect("a folder");
    fs::write(path.join("foreign/letter.txt"), "dear").expect("written");
    let sentence = refuse(path, &check(&["--row", "9", "--out", "foreign"]));
    assert!(sentence.contains("contains other files"), "{sentence}");
}

#[test]
fn sets_have_names_of_their_own() {
    let folder = folder(&[]);
    let sentence = refuse(folder.path(), &["check-behaviour", "--set", "second"]);
    assert!(sentence.contains("second") && sentence.contains("--set"), "{sentence}");
    let sentence = refuse(folder.path(), &check(&["--set", "drawn"]));
    assert!(sentence.contains("--set") && sentence.contains("--scenes"), "{sentence}");
}

/// Every bundled scene can be simulated, unchanged and in every reflection.
#[test]
fn the_scenes_of_the_house_are_sound() {
    for (set, least) in [(SceneSet::First, 31), (SceneSet::Drawn, 57), (SceneSet::All, 88)] {
        let files = set.folders().into_iter().flat_map(|folder| fs::read_dir(folder).expect("the scenes"));
        let paths = files.flatten().map(|entry| entry.path());
        let mut scenes = 0;
        for path in paths.filter(|path| path.extension().is_some_and(|extension| extension == "json")) {
            for recording in phase_events::read(&path).expect("readable") {
                let id = &recording.id;
                scenes += 1;
                assert_eq!(recording.scene.validate_without_overlap(), Ok(()), "{id}");
                for flip in Flip::ALL {
                    let mirrored = recording.scene.mirrored(flip).expect("no mirror yet");
                    assert_eq!(mirrored.validate_without_overlap(), Ok(()), "{id} {flip:?}");
                }
            }
        }
        assert!(scenes >= least, "{scenes} scenes in the set {}", set.name());
    }
}
