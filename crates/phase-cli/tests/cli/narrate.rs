//! Events in words.

use crate::support::{refuse, succeed};

#[test]
fn events_are_told_at_three_lengths_and_without_intents() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let effort = ["--max-steps", "8", "--simulations", "10", "--particles", "4"];
    succeed(path, &[&["gen-dataset", "--events", "2", "--no-video", "--out", "data"], &effort[..]].concat());
    let one = ["narrate", "data", "--id", "demo-0000", "--length"];
    let [short, medium, long, seen] =
        ["short", "medium", "long", "seen"].map(|length| succeed(path, &[&one[..], &[length]].concat()));
    assert!(medium.starts_with(short.trim_end()) && long.starts_with(medium.trim_end()), "{long}");
    assert!(long.ends_with(&seen) && seen.contains("At the end, after 2 s"), "{seen}");
    let all = succeed(path, &["narrate", "data"]);
    assert!(all.contains("demo-0000\n") && all.contains("demo-0001\n"), "{all}");
    let json: serde_json::Value =
        serde_json::from_str(&succeed(path, &["narrate", "data", "--json"])).expect("JSON");
    assert_eq!(json["events"][0]["short"], short.trim_end());
    refuse(path, &["narrate", "data", "--id", "nobody"]);
    refuse(path, &["narrate", "nowhere.json"]);
}
