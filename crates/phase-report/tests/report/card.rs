//! The card that people and loaders read.

use phase_dataset::{manifest::Manifest, overview::Overview, parquet::descriptions, splits::Split};
use phase_evidence::Manner;
use phase_report::card;
use std::collections::BTreeSet;

/// The card of a dataset whose manifest is in memory.
fn card(manifest: &Manifest, command: &str, shortcuts: &str) -> String {
    card::card(&Overview::of(manifest), command, shortcuts)
}

fn example() -> Manifest {
    let folder = tempfile::tempdir().expect("a folder");
    crate::support::dataset(folder.path(), "demo-0000")
}

#[test]
fn the_card_names_command_kinds_and_licence() {
    let card = card(&example(), "cargo xtask gen-dataset --seed 3", "\n| told from |\n");
    for part in ["cargo xtask gen-dataset --seed 3", "| helping | 1 |", "MIT OR Apache-2.0", "manifest.json"]
    {
        assert!(card.contains(part), "{part}");
    }
}

#[test]
fn agents_that_do_not_know_the_others_goal_are_counted() {
    let mut manifest = example();
    manifest.events[0].manners = vec![Manner::MistakenHelp];
    let text = card(&manifest, "", "");
    assert!(!text.contains("level of reasoning") && !text.contains("mistaken-help"));
    manifest.events[0].agents.iter_mut().for_each(|agent| agent.level = Some(phase_model::Level::Two));
    let text = card(&manifest, "", "");
    assert!(text.contains("\n| 2 | 2 | infers it, and assumes that the other infers, too |\n"));
    assert!(
        text.contains(
            "\n| mistaken-help | 1 | the helper is wrong for a while about what the other wants |\n"
        )
    );
}

#[test]
fn the_front_matter_names_the_splits_there_are() {
    let mut manifest = example();
    let front = |card: &str| card.split("---\n").nth(1).expect("front matter").to_owned();
    let of_one = front(&card(&manifest, "", ""));
    assert!(of_one.contains("  - split: train\n    path: data/train-*.parquet\n"), "{of_one}");
    assert!(of_one.contains("- n<1K\n") && !of_one.contains("split: test"), "{of_one}");

    let event = manifest.events[0].clone();
    manifest.events = vec![event; 1_000];
    manifest.events[7].split = Some(Split::Test);
    let of_many = front(&card(&manifest, "", ""));
    assert!(of_many.contains("  - split: test\n    path: data/test-*.parquet\n"), "{of_many}");
    assert!(of_many.contains("- 1K<n<10K\n") && !of_many.contains("split: validation"), "{of_many}");
}

#[test]
fn the_front_matter_survives_any_name() {
    let mut manifest = example();
    manifest.preset = "a\": b\n---\n# c".into();
    let text = card(&manifest, "", "");
    assert!(text.starts_with("---\npretty_name: \"PHASE events: a\\\": b\\n---\\n# c\"\nlicense:"), "{text}");
}

#[test]
fn every_column_is_described_in_the_card_and_in_the_formats() {
    let formats = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/reference/formats/datasets.md");
    let formats = std::fs::read_to_string(formats).expect("the formats");
    let text = card(&example(), "", "");
    let columns = descriptions();
    assert_eq!(columns.iter().map(|column| column.name).collect::<BTreeSet<_>>().len(), columns.len());
    for column in columns {
        assert!(text.contains(&format!("\n| `{}` |", column.name)), "card: {}", column.name);
        assert!(formats.contains(&format!("`{}`", column.name)), "formats: {}", column.name);
        assert!(!column.what.contains('|'), "{} would break the table", column.name);
    }
}
