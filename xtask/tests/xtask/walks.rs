//! The documents that are to be followed from top to bottom, followed from top to bottom.

use crate::{
    documents::{commands, shell},
    support::succeed,
};
use serde_json::Value;
use std::{
    fs,
    path::{Path, PathBuf},
};

/// Runs every command of `phase` and `cargo xtask` in a document, in an empty folder; `before` sees each of them first.
fn walk(document: &str, folder: &Path, before: impl Fn(&str)) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs").join(document);
    let text = fs::read_to_string(path).expect("a document");
    let mut count = 0;
    for words in shell(&text).iter().flat_map(|line| commands(line)) {
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let (["cargo", "xtask", arguments @ ..] | ["phase", arguments @ ..]) = words.as_slice() else {
            panic!("{document}: {words:?} is none of our commands")
        };
        before(&arguments.join(" "));
        succeed(folder, arguments);
        count += 1;
    }
    assert!(count > 0, "{document}");
}

/// Files named in backticks that begin with `out/`.
fn named(document: &str) -> Vec<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs").join(document);
    let text = fs::read_to_string(path).expect("a document");
    let quoted = text.split('`').skip(1).step_by(2).filter(|word| word.starts_with("out/"));
    quoted.map(PathBuf::from).collect()
}

#[test]
fn the_tutorial() {
    let folder = tempfile::tempdir().expect("a folder");
    walk("tutorial.md", folder.path(), |_| {});
    let named = named("tutorial.md");
    assert!(named.len() > 2, "{named:?}");
    for file in named {
        assert!(folder.path().join(&file).exists(), "{}", file.display());
    }
}

#[test]
fn stimuli_by_hand() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    // As the document says: copy the event, give it another id, change one thing.
    let pair = |command: &str| {
        if command.contains("pair.json") {
            let text = fs::read_to_string(path.join("scene.json")).expect("a scene");
            let mut scenes: Value = serde_json::from_str(&text).expect("JSON");
            let mut other = scenes["events"][0].clone();
            other["id"] = "other".into();
            other["agents"][0]["strength_level"] = 0.into();
            scenes["events"].as_array_mut().expect("events").push(other);
            fs::write(path.join("pair.json"), scenes.to_string()).expect("written");
        }
    };
    walk("how-to/stimuli.md", path, pair);
    for file in named("how-to/stimuli.md") {
        assert!(path.join(&file).exists(), "{}", file.display());
    }
}
