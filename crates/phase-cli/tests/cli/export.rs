//! `export`, read back with the program `tar`, which is not ours.

use crate::support::{refuse, succeed, text, tree};
use serde_json::Value;
use std::{fs, path::Path, process::Command};

/// A dataset of three events with videos.
fn dataset(path: &Path) {
    let effort = ["--max-steps", "2", "--simulations", "10", "--particles", "4"];
    let made =
        [&["gen-dataset", "--events", "3", "--date-published", "2026-11-23", "--out", "data"], &effort[..]];
    succeed(path, &made.concat());
}

/// Reads all labels with the types that the first sample has.
const TYPES_OF_THE_FIRST: &str = r#"
import glob, json, sys
try:
    import pyarrow
except ImportError:
    print("skipped: there is no pyarrow")
    sys.exit()
labels = [json.load(open(file)) for file in sorted(glob.glob("*.json"))]
schema = pyarrow.Table.from_pylist(labels[:1]).schema
assert pyarrow.Table.from_pylist(labels, schema=schema).to_pylist() == labels
"#;

#[test]
fn tar_reads_what_was_exported() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    dataset(path);
    let export = ["export", "data", "--events-per-file", "2", "--out"];
    let told = succeed(path, &[&export[..], &["one"]].concat());
    assert!(told.contains("2 tar files in one"), "{told}");
    succeed(path, &[&export[..], &["other"]].concat());
    assert!(tree(&path.join("one")) == tree(&path.join("other")), "the same dataset gives the same bytes");
    assert!(succeed(path, &[&export[..], &["one"]].concat()).contains("already"));

    fs::create_dir(path.join("read")).expect("a folder");
    for file in ["train-00000.tar", "train-00001.tar"] {
        let tar =
            Command::new("tar").args(["-xf", file, "-C", "../read"]).current_dir(path.join("one")).output();
        let tar = tar.expect("tar");
        assert!(tar.status.success(), "{}", text(&tar.stderr));
    }
    for id in ["demo-0000", "demo-0001", "demo-0002"] {
        for (ours, theirs) in [("events", "json"), ("videos", "mp4")] {
            let original = fs::read(path.join(format!("data/{ours}/{id}.{theirs}"))).expect("the original");
            let ending = if theirs == "json" { "phase-events" } else { theirs };
            assert!(fs::read(path.join(format!("read/{id}.{ending}"))).expect("a copy") == original);
        }
        let labels = fs::read(path.join(format!("read/{id}.json"))).expect("labels");
        let labels: Value = serde_json::from_slice(&labels).expect("JSON");
        assert_eq!(labels["id"], id);
    }
    let arrow =
        Command::new("python3").args(["-c", TYPES_OF_THE_FIRST]).current_dir(path.join("read")).output();
    match arrow {
        Ok(arrow) => {
            assert!(arrow.status.success(), "{}", text(&arrow.stderr));
            eprint!("{}", text(&arrow.stdout));
        }
        Err(_) => eprintln!("skipped: there is no python3"),
    }
    // The labels of videos, as the videofolder loader reads them.
    let table = fs::read_to_string(path.join("data/videos/metadata.csv")).expect("a table");
    assert_eq!(table.lines().count(), 4);
    assert!(table.contains("\ndemo-0000.mp4,demo-0000,"), "{table}");
    let croissant = fs::read_to_string(path.join("data/croissant.json")).expect("a description");
    assert!(croissant.contains("\"datePublished\": \"2026-11-23\""), "{croissant}");
}

#[test]
fn what_cannot_be_exported_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let told = refuse(path, &["export", "nothing", "--out", "out"]);
    assert!(told.contains("nothing"), "{told}");
    dataset(path);
    succeed(path, &["export", "data", "--out", "out"]);
    let told = refuse(path, &["export", "data", "--events-per-file", "7", "--out", "out"]);
    assert!(told.contains("events_per_file"), "{told}");
    // What is there is not what was exported.
    let tar = path.join("out/train-00000.tar");
    let whole = fs::read(&tar).expect("a file");
    for (changed, part) in [
        (Some(&whole[..whole.len() / 2]), "train-00000.tar: differs in size"),
        (None, "train-00000.tar: cannot be read"),
    ] {
        match changed {
            Some(bytes) => fs::write(&tar, bytes).expect("written"),
            None => fs::remove_file(&tar).expect("removed"),
        }
        let told = refuse(path, &["export", "data", "--out", "out"]);
        assert!(told.contains(part), "{told}");
    }
    fs::write(&tar, &whole).expect("written");
    let index = fs::read(path.join("out/index.json")).expect("a list");
    let mut index: Value = serde_json::from_slice(&index).expect("JSON");
    index["files"] = Value::Array(Vec::new());
    fs::write(path.join("out/index.json"), index.to_string()).expect("written");
    let told = refuse(path, &["export", "data", "--out", "out"]);
    assert!(told.contains("index.json: field `files`"), "{told}");
    fs::write(path.join("data/videos/demo-0001.mp4"), "x").expect("written");
    let output = crate::support::run(path, &["export", "data", "--out", "again"]);
    let told = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("videos/demo-0001.mp4"), "{told}");
    for date in ["2026-02-30", "23.11.2026", "2026-1-2"] {
        let told = text(&crate::support::run(path, &["gen-dataset", "--date-published", date]).stderr);
        assert!(told.contains("a date is YYYY-MM-DD"), "{told}");
    }
}
