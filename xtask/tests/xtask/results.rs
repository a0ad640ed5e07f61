//! No figure of the documents that show results was typed.

use crate::support::tree;
use phase_eval::{
    benchmark::{Benchmark, Row},
    goals::{Agreement, Protocol, RecognitionSummary},
};
use std::{fs, path::Path};
use xtask::results::documents;

/// Sources of the documents, beside the leaderboard.
const SOURCES: [&str; 6] = [
    "data/questions.json",
    "data/report-model.training.json",
    "data/results.json",
    "docs/results/overview.md",
    "docs/results/leaderboard.md",
    "README.md",
];

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

/// A folder with what the documents are made of.
fn copied() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (file, bytes) in tree(&root().join("data/leaderboard")) {
        let place = folder.path().join("data/leaderboard").join(file);
        fs::create_dir_all(place.parent().expect("a folder")).expect("a folder");
        fs::write(place, bytes).expect("written");
    }
    for file in SOURCES {
        let place = folder.path().join(file);
        fs::create_dir_all(place.parent().expect("a folder")).expect("a folder");
        fs::copy(root().join(file), place).expect("a copy");
    }
    folder
}

#[test]
fn a_typed_figure_is_noticed() {
    let folder = copied();
    let differs = |file: &str| {
        let there = fs::read_to_string(folder.path().join(file)).expect("a document");
        let documents = documents(folder.path()).expect("documents");
        documents.into_iter().any(|(other, text)| other == Path::new(file) && text != there)
    };
    for file in ["docs/results/overview.md", "README.md", "docs/results/leaderboard.md"] {
        assert!(!differs(file), "{file}");
        let path = folder.path().join(file);
        let text = fs::read_to_string(&path).expect("a document");
        // What people reach, in every document.
        assert!(text.contains("| 0.970 |"), "{file}");
        fs::write(&path, text.replacen("| 0.970 |", "| 0.980 |", 1)).expect("written");
        assert!(differs(file), "{file}");
    }
}

/// The results file says of every agreement with people whether the model knew their ratings, and the page
/// shows what it says.
#[test]
fn figures_in_sample_cannot_be_shown_as_held_out() {
    let folder = copied();
    let file = folder.path().join("data/results.json");
    let text = fs::read_to_string(&file).expect("figures");
    let genuine: Benchmark = serde_json::from_str(&text).expect("a benchmark");
    let row = |row: &Row<RecognitionSummary>| row.summary.held_out_agreement.is_some();
    let place = genuine.goals.iter().position(row).expect("a method that was fitted to ratings");
    let refused = |change: &dyn Fn(&mut RecognitionSummary)| {
        let mut changed = genuine.clone();
        change(&mut changed.goals[place].summary);
        fs::write(&file, serde_json::to_string(&changed).expect("JSON")).expect("written");
        documents(folder.path()).err().map(|error| error.to_string()).unwrap_or_default()
    };
    assert_eq!(refused(&|_| {}), "");
    let label = Protocol::HeldOut { folds: 10 };
    let changes: [&dyn Fn(&mut RecognitionSummary); 5] = [
        // The figures of the model itself, in the place of the others.
        &|it| {
            let own = it.agreement.clone().expect("an agreement");
            it.held_out_agreement = Some(Agreement { protocol: label, ..own });
        },
        // Its own figures labelled as held out, or as those of a model that knew no ratings.
        &|it| it.agreement.as_mut().expect("an agreement").protocol = label,
        &|it| it.agreement.as_mut().expect("an agreement").protocol = Protocol::Unfitted,
        // Held out, but labelled in-sample; another figure than that of the record.
        &|it| it.held_out_agreement.as_mut().expect("an agreement").protocol = Protocol::InSample,
        &|it| it.held_out_agreement.as_mut().expect("an agreement").mode.value = 0.99,
    ];
    for change in changes {
        let said = refused(change);
        assert!(said.contains("data/results.json") && said.contains("simple on recorded events"), "{said}");
    }
    // Without figures held out, the page says that the others are in-sample.
    assert_eq!(refused(&|it| it.held_out_agreement = None), "");
    let page = documents(folder.path()).expect("documents").into_iter();
    let page = page.filter(|(file, _)| file == Path::new("docs/results/overview.md")).map(|(_, text)| text);
    let page: String = page.collect();
    assert!(page.contains("the reports that it predicts, in-sample |"), "{page}");
    assert!(page.contains("fitted to these very ratings"), "{page}");
}
