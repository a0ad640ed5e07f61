//! Files written once all events of a dataset exist: everything that describes the whole.
//!
//! Events are read back from the folder one at a time, so memory grows with the number of events only by
//! their entries in the manifest. Code for further files of a dataset belongs here.

use crate::{error::CliError, gallery_writer::GalleryWriter, interrupt, shortcuts};
use phase_audit::{AuditItem, MAX_EVENTS, audit};
use phase_dataset::{
    FileError, Problem,
    acceptance::Tally,
    atomic,
    checksum::FileEntry,
    croissant::{CROISSANT_FILE, croissant},
    event_set::{PAIRS_FILE, pairs_table},
    manifest::{CARD_FILE, DATASET_FORMAT, EventEntry, MANIFEST_FILE, Manifest},
    parquet, phase_events,
    shard::DatasetDescription,
    slot_record::SlotRecord,
    video_table::{VIDEO_TABLE_FILE, video_table},
};
use phase_event::Recording;
use phase_report::{
    card::{self, card},
    gallery::{Gallery, Timeline},
};
use std::path::Path;

/// Writes the files that describe the whole; the manifest last, since with it the dataset is complete.
/// `records` are those of all slots, in order.
///
/// # Errors
/// If an event cannot be read back, a file cannot be written, or the run was interrupted.
pub fn complete(
    out: &Path,
    whole: &DatasetDescription,
    records: impl Iterator<Item = SlotRecord>,
) -> Result<Manifest, CliError> {
    let (mut events, mut sets) = (Vec::new(), Vec::new());
    let mut tally = Tally::default();
    let gallery = Gallery {
        preset: &whole.preset,
        generator: &whole.generator,
        seed: whole.seed,
        events: whole.events,
    };
    let mut pages = whole.videos.then(|| GalleryWriter::new(out, gallery));
    let mut audited = Vec::new();
    for record in records {
        tally.add(record.entries.iter().filter_map(|entry| entry.variant), &record.refused);
        for entry in record.entries {
            let recording = read_back(out, &entry)?;
            if audited.len() < MAX_EVENTS {
                audited.push(AuditItem::of(&recording));
            }
            if let (Some(pages), Some(simulation)) = (&mut pages, &recording.simulation) {
                pages.push(entry.clone(), Timeline::of(&simulation.event))?;
            }
            events.push(entry);
        }
        sets.extend(record.set);
    }
    let mut manifest = Manifest {
        format: DATASET_FORMAT.into(),
        generator: whole.generator.clone(),
        preset: whole.preset.clone(),
        seed: whole.seed,
        date_published: whole.date_published.clone(),
        settings: whole.settings.clone(),
        selection: if whole.selected { tally.rows() } else { Vec::new() },
        events,
        sets,
        files: Vec::new(),
    };
    let Some(files) = parquet::export(out, &manifest.events, &interrupt::requested)? else {
        return Err(CliError::Interrupted(out.to_owned()));
    };
    manifest.files = files;
    if !manifest.sets.is_empty() {
        let place = |id: &str| manifest.events.iter().find(|entry| entry.id == id)?.set.as_ref();
        let table = pairs_table(&manifest.sets, place);
        describe(out, &mut manifest, PAIRS_FILE, &table)?;
    }
    for page in pages.map_or_else(|| Ok(Vec::new()), GalleryWriter::finish)? {
        manifest.files.push(FileEntry::of(out, page).map_err(CliError::ReadBack)?);
    }
    if whole.videos {
        let table = video_table(&manifest.events);
        describe(out, &mut manifest, VIDEO_TABLE_FILE, &table)?;
    }
    let count = manifest.events.len();
    let shortcuts = shortcuts::section(audit(&audited, count).as_ref(), count);
    let text = card(&manifest, &whole.command, &shortcuts);
    describe(out, &mut manifest, CARD_FILE, &text)?;
    let text = croissant(&manifest, card::about());
    describe(out, &mut manifest, CROISSANT_FILE, &text)?;
    manifest.write(&out.join(MANIFEST_FILE))?;
    Ok(manifest)
}

/// Writes a file that does not belong to a single event, and adds it to the manifest.
fn describe(out: &Path, manifest: &mut Manifest, name: &str, text: &str) -> Result<(), CliError> {
    atomic::write(&out.join(name), text.as_bytes())?;
    manifest.files.push(FileEntry::of(out, name).map_err(CliError::ReadBack)?);
    Ok(())
}

/// The event of an entry, from its file.
fn read_back(out: &Path, entry: &EventEntry) -> Result<Recording, CliError> {
    let file = out.join(&entry.event.path);
    let recordings = phase_events::read(&file).map_err(CliError::ReadBack)?;
    let simulated = recordings.into_iter().find(|recording| recording.simulation.is_some());
    simulated.ok_or(CliError::ReadBack(FileError {
        file,
        problem: Problem::Shape { what: "event of a dataset", rule: "it was not simulated".into() },
    }))
}
