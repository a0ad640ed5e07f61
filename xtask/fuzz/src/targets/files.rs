//! Readers of files in folders.

use phase_dataset::{
    manifest::Manifest,
    shard::{SHARD_FILE, Shard},
    slot_record::SlotRecord,
    split_list::SplitList,
    summary::SimulationSummary,
};
use std::{fs, path::Path};
use tempfile::TempDir;

/// A folder with one file.
fn folder_with(name: &str, data: &[u8]) -> TempDir {
    let folder = TempDir::new().expect("a temporary folder");
    let file = folder.path().join(name);
    fs::create_dir_all(file.parent().unwrap_or(Path::new("/"))).expect("a folder in it");
    fs::write(file, data).expect("a file in it");
    folder
}

/// Manifests: what is accepted is written, and read again the same.
pub(super) fn manifest(data: &[u8]) {
    let folder = folder_with("manifest.json", data);
    let file = folder.path().join("manifest.json");
    let Ok(manifest) = Manifest::read(&file) else { return };
    let text = manifest.to_text().expect("what is read can be written");
    fs::write(&file, &text).expect("written");
    let again = Manifest::read(&file).expect("what is written can be read");
    assert_eq!(again.to_text().expect("written"), text);
    assert!(manifest.verify(folder.path()).is_err() || manifest.events.is_empty());
    let _ = manifest.items();
}

/// Shards, records of slots, lists of splits, summaries.
pub(super) fn records(data: &[u8]) {
    let folder = folder_with(SHARD_FILE, data);
    let file = folder.path().join(SHARD_FILE);
    let _ = (Shard::read(folder.path()), SplitList::read(&file), SimulationSummary::read(&file));
    let _ = SlotRecord::load(&file, "fuzz");
}
