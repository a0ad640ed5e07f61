//! The documents that are to be followed from top to bottom, followed from top to bottom.

use crate::{
    shell::{commands, shell},
    support::succeed,
};
use serde_json::Value;
use std::{fs, path::Path};

/// The text of a document.
fn text_of(document: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(document);
    fs::read_to_string(path).expect("a document")
}

/// Runs every command of `phase` and `cargo xtask` in a document, in an empty folder; `before` sees each of
/// them first, and says whether it did itself what the command does.
fn walk(document: &str, folder: &Path, before: impl Fn(&[&str]) -> bool) {
    let text = text_of(document);
    let mut count = 0;
    for words in shell(&text).iter().flat_map(|line| commands(line)) {
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let (["cargo", "xtask", arguments @ ..] | ["phase", arguments @ ..]) = words.as_slice() else {
            panic!("{document}: {words:?} is none of our commands")
        };
        if !before(arguments) {
            succeed(folder, arguments);
        }
        count += 1;
    }
    assert!(count > 0, "{document}");
}

/// Runs a document's commands, then looks for the files that it names in backticks, below a folder.
pub(crate) fn walk_and_look(document: &str, folder: &Path, below: &str, before: impl Fn(&[&str]) -> bool) {
    walk(document, folder, before);
    let text = text_of(document);
    // A block of code is no word in backticks.
    let prose: Vec<&str> = text.split("```").step_by(2).collect();
    let words = prose.iter().flat_map(|part| part.split('`').skip(1).step_by(2));
    let named: Vec<&str> = words.filter(|word| word.starts_with(below) && !word.contains(' ')).collect();
    assert!(!named.is_empty(), "{document} names no file");
    for file in named {
        assert!(folder.join(file).exists(), "{document}: {file}");
    }
}

#[test]
fn the_tutorial() {
    let folder = tempfile::tempdir().expect("a folder");
    walk_and_look("tutorial.md", folder.path(), "out/", |_| false);
}

#[test]
fn stimuli_by_hand() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    // As the document says: copy the event, give it another id, change one thing.
    let pair = |arguments: &[&str]| {
        if arguments.contains(&"pair.json") {
            let text = fs::read_to_string(path.join("scene.json")).expect("a scene");
            let mut scenes: Value = serde_json::from_str(&text).expect("JSON");
            let mut other = scenes["events"][0].clone();
            other["id"] = "other".into();
            other["agents"][0]["strength_level"] = 0.into();
            scenes["events"].as_array_mut().expect("events").push(other);
            fs::write(path.join("pair.json"), scenes.to_string()).expect("written");
        }
        false
    };
    walk_and_look("how-to/stimuli.md", path, "out/", pair);
}

#[test]
fn minimal_pairs() {
    let folder = tempfile::tempdir().expect("a folder");
    // The document's only block of JSON is the preset.
    let text = text_of("how-to/pairs.md");
    let preset = text.split("```json").nth(1).and_then(|rest| rest.split("```").next()).expect("a preset");
    fs::write(folder.path().join("pairs.json"), preset).expect("written");
    walk_and_look("how-to/pairs.md", folder.path(), "out/", |_| false);
}
