//! Writing the files that describe a dataset again, and comparing them with those that are there.

use crate::{
    error::RunError,
    gen_dataset::complete::{Completed, describe_all},
    listener::Listener,
};
use phase_dataset::{
    manifest::{CARD_FILE, DIGEST_FILE, EventEntry, MANIFEST_FILE, Manifest},
    overview::Overview,
    slot_record::{Records, SlotRecord},
    video_table::VIDEO_TABLE_FILE,
};
use phase_files::{FileError, Problem, WriteError, checksum::FileEntry, json};
use std::{collections::BTreeMap, path::Path};

/// The files that differ from what the event files, the manifest's list of events and the command in the card
/// give.
pub(super) fn problems(
    folder: &Path,
    manifest: &Manifest,
    listener: &dyn Listener,
) -> Result<Vec<FileError>, RunError> {
    let path = std::env::temp_dir();
    let scratch = tempfile::tempdir()
        .map_err(|source| RunError::Output(WriteError { path, action: "create a folder", source }))?;
    let differs = |name: &str| FileError {
        file: folder.join(name),
        problem: Problem::Differs("what the events give".into()),
    };
    let Some(command) = command(folder)? else { return Ok(vec![differs(CARD_FILE)]) };
    let again = rewrite((folder, scratch.path()), manifest, &command, listener)?;
    let files = again.overview.files.iter().map(|file| file.path.as_str());
    let mut found = Vec::new();
    for name in files.chain([DIGEST_FILE, MANIFEST_FILE]) {
        let there = FileEntry::of(folder, name)?;
        let here = FileEntry::of(scratch.path(), name)?;
        if there != here {
            found.push(differs(name));
        }
    }
    Ok(found)
}

/// The command that made a dataset, as its card has it.
///
/// # Errors
/// If the card cannot be read.
pub fn command(folder: &Path) -> Result<Option<String>, FileError> {
    let text = json::bytes(&folder.join(CARD_FILE))?;
    let text = String::from_utf8_lossy(&text);
    let command = text.split("```sh\n").nth(1).and_then(|rest| rest.split("\n```").next());
    Ok(command.map(String::from))
}

/// Writes the files that describe the events of a manifest, itself among them, from the event files in one
/// folder into another, or into the same.
///
/// # Errors
/// If an event cannot be read or a file cannot be written.
pub fn rewrite(
    (from, out): (&Path, &Path),
    manifest: &Manifest,
    command: &str,
    listener: &dyn Listener,
) -> Result<Completed, RunError> {
    let overview = Overview { files: Vec::new(), ..Overview::of(manifest) };
    if let Some(table) = out.join(VIDEO_TABLE_FILE).parent().filter(|_| overview.videos) {
        let failed = |source| WriteError { path: table.to_owned(), action: "create the folder", source };
        std::fs::create_dir_all(table).map_err(failed).map_err(RunError::Output)?;
    }
    describe_all((from, out), overview, command, &ListedEvents(manifest), listener)
}

/// The events of a manifest as the records of their slots.
struct ListedEvents<'a>(&'a Manifest);

impl Records for ListedEvents<'_> {
    fn records(&self) -> Box<dyn Iterator<Item = Result<SlotRecord, FileError>> + '_> {
        let sets: BTreeMap<&str, _> = self.0.sets.iter().map(|set| (set.id.as_str(), set)).collect();
        // The events of a set follow one another.
        let slots = self.0.events.chunk_by(|a, b| set_of(a).is_some() && set_of(a) == set_of(b));
        Box::new(slots.map(move |entries| {
            let set = entries.first().and_then(set_of).and_then(|id| sets.get(id));
            Ok(SlotRecord {
                entries: entries.to_vec(),
                set: set.map(|&set| set.clone()),
                ..SlotRecord::default()
            })
        }))
    }
}

/// The set that an event belongs to.
fn set_of(entry: &EventEntry) -> Option<&str> {
    entry.set.as_ref().map(|place| place.set.as_str())
}
