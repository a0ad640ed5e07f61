//! No figure of the documents that show results was typed.

use crate::support::tree;
use std::{fs, path::Path};
use xtask::results::documents;

/// What the documents are made of, beside the leaderboard.
const SOURCES: [&str; 4] = ["docs/results.json", "docs/results.md", "docs/leaderboard.md", "README.md"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("a workspace")
}

#[test]
fn the_documents_are_what_the_benchmark_wrote() {
    let documents = documents(root()).expect("documents");
    assert!(documents.len() >= 2);
    for (file, text) in documents {
        let there = fs::read_to_string(root().join(&file)).expect("a document");
        assert!(there == text, "{}: run `cargo xtask results`", file.display());
    }
}

#[test]
fn a_typed_figure_is_noticed() {
    let folder = tempfile::tempdir().expect("a folder");
    for (file, bytes) in tree(&root().join("docs/leaderboard")) {
        let place = folder.path().join("docs/leaderboard").join(file);
        fs::create_dir_all(place.parent().expect("a folder")).expect("a folder");
        fs::write(place, bytes).expect("written");
    }
    for file in SOURCES {
        fs::copy(root().join(file), folder.path().join(file)).expect("a copy");
    }
    let differs = |file: &str| {
        let there = fs::read_to_string(folder.path().join(file)).expect("a document");
        let documents = documents(folder.path()).expect("documents");
        documents.into_iter().any(|(other, text)| other == Path::new(file) && text != there)
    };
    for file in ["docs/results.md", "README.md", "docs/leaderboard.md"] {
        assert!(!differs(file), "{file}");
        let path = folder.path().join(file);
        let text = fs::read_to_string(&path).expect("a document");
        // What people reach, in every document.
        assert!(text.contains("| 0.970 |"), "{file}");
        fs::write(&path, text.replacen("| 0.970 |", "| 0.980 |", 1)).expect("written");
        assert!(differs(file), "{file}");
    }
}
