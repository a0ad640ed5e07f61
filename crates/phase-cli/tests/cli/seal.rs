//! Sealed datasets, from the secret seed to the proof.

use crate::support::{fail, refuse, succeed};
use serde_json::Value;
use std::{fs, path::Path};

const SEED: &str = "11259375999999999999";

fn generate(path: &Path, out: &str, seed: &str) {
    let effort = ["--max-steps", "8", "--simulations", "10", "--particles", "4", "--size", "64"];
    succeed(path, &[&["gen-dataset", "--events", "6", "--seed", seed, "--out", out], &effort[..]].concat());
}

#[test]
fn what_was_published_is_proved_later() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "secret", SEED);
    succeed(path, &["seal", "secret", "--out", "public"]);
    let text = fs::read_to_string(path.join("public/events.json")).expect("events");
    let events = phase_event::parse_observed(text.as_bytes()).expect("events without labels");
    assert_eq!(events.len(), 6);
    let published: Value = serde_json::from_str(&text).expect("JSON");
    let members: Vec<&String> = published["events"][0].as_object().expect("an event").keys().collect();
    assert_eq!(members, ["agents", "id", "layout", "objects", "trajectory"]);
    assert_eq!(published["events"][0]["agents"][0].as_object().map(|it| it.len()), Some(1), "sizes alone");
    for secret in ["demo-", SEED, "alpha", "goal", "helping"] {
        assert!(!text.contains(secret), "{secret}");
    }
    // The order is another, so that a place tells no kind.
    let proof = succeed(path, &["unseal", "public", "--dataset", "secret", "--json"]);
    let names: Value = serde_json::from_str(&proof).expect("JSON");
    let ids: Vec<&str> =
        names["events"].as_object().expect("names").values().filter_map(Value::as_str).collect();
    assert_eq!(ids.len(), 6);
    assert!(!ids.is_sorted(), "{ids:?}");
    // The motion under a name is that of its event.
    let id = names["events"]["sealed-0001"].as_str().expect("a name");
    let event = fs::read_to_string(path.join(format!("secret/events/{id}.json"))).expect("an event");
    let event: Value = serde_json::from_str(&event).expect("JSON");
    assert_eq!(event["events"][0]["trajectory"], published["events"][0]["trajectory"]);
    assert_eq!(
        fs::read(path.join("public/videos/sealed-0001.mp4")).expect("a video"),
        fs::read(path.join(format!("secret/videos/{id}.mp4"))).expect("a video")
    );
}

#[test]
fn another_dataset_or_a_changed_file_is_no_proof() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "secret", SEED);
    succeed(path, &["seal", "secret", "--out", "public"]);
    generate(path, "other", "11259375999999999998");
    let told = fail(path, &["unseal", "public", "--dataset", "other"]);
    assert!(told.contains("the manifest of other is not what was sealed"), "{told}");
    refuse(path, &["seal", "secret", "--out", "public"]);
    let file = path.join("public/events.json");
    let text = fs::read_to_string(&file).expect("events").replacen("0.", "1.", 1);
    fs::write(&file, text).expect("written");
    let told = fail(path, &["unseal", "public", "--dataset", "secret"]);
    assert!(told.contains("events.json"), "{told}");
    generate(path, "guessable", "7");
    let told = fail(path, &["seal", "guessable", "--out", "no"]);
    assert!(told.contains("seed 7 can be found by trying"), "{told}");
    assert!(!path.join("no").exists());
}
