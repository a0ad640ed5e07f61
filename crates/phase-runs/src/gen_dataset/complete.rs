//! Files written once all events of a dataset exist: everything that describes the whole.
//!
//! Records and events are read back from the folder one at a time, in two passes: the first counts, the
//! second writes what lists them. So memory does not grow with the number of events. Code for further files
//! of a dataset belongs here.

use crate::{error::RunError, gallery_writer::GalleryWriter, interrupt, listener::Listener, shortcuts};
use phase_audit::{AuditItem, MAX_EVENTS, audit};
use phase_dataset::{
    acceptance::Tally,
    croissant::{CROISSANT_FILE, croissant},
    event_set::{PAIRS_FILE, PAIRS_HEADER, pair_rows},
    manifest::{CARD_FILE, EventEntry},
    manifest_writer::write_manifest,
    overview::Overview,
    parquet::ParquetWriter,
    phase_events,
    shard::DatasetDescription,
    slot_record::Records,
    video_table::{VIDEO_TABLE_FILE, VIDEO_TABLE_HEADER, video_row},
};
use phase_event::Recording;
use phase_files::{
    FileError, Problem,
    measured::{self, MeasuredFile},
};
use phase_report::{
    card::{self, card},
    gallery::{Gallery, Timeline},
};
use std::{io::Write, path::Path};

/// A dataset that is complete.
#[derive(Debug)]
pub struct Completed {
    /// Summary of the dataset.
    pub overview: Overview,
    /// SHA-256 of its manifest, in hexadecimal.
    pub digest: String,
}

/// Writes the files that describe the whole; the manifest last, since with it the dataset is complete.
/// `records` are those of all slots, in order.
///
/// # Errors
/// If a record or an event cannot be read back, a file cannot be written, or the run was interrupted.
pub fn complete(
    out: &Path,
    whole: &DatasetDescription,
    records: &dyn Records,
    listener: &dyn Listener,
) -> Result<Completed, RunError> {
    let overview = count(whole, records)?;
    describe_all((out, out), overview, &whole.command, records, listener)
}

/// Writes the files that describe a dataset whose events have been counted into a folder; the events
/// themselves are in another folder, or in the same. `overview` names no files yet.
pub(crate) fn describe_all(
    (from, out): (&Path, &Path),
    mut overview: Overview,
    command: &str,
    records: &dyn Records,
    listener: &dyn Listener,
) -> Result<Completed, RunError> {
    let progress = listener.progress_over("writing tables, page and manifest", overview.events);
    let preset = overview.preset.clone();
    let generator = overview.generator.clone();
    let gallery = Gallery {
        preset: &preset,
        generator: &generator,
        seed: overview.seed,
        events: overview.events,
        overlay: None,
    };
    let mut pages = overview.videos.then(|| GalleryWriter::new(out, gallery));
    let mut parquet = ParquetWriter::new(out, &overview.splits)?;
    let videos = overview.videos.then_some((VIDEO_TABLE_FILE, VIDEO_TABLE_HEADER));
    let mut videos = videos.map(|(name, header)| Table::create(out, name, header)).transpose()?;
    let sets = (overview.sets > 0).then_some((PAIRS_FILE, PAIRS_HEADER));
    let mut sets = sets.map(|(name, header)| Table::create(out, name, header)).transpose()?;
    let mut audited = Vec::new();
    for record in records.records() {
        let record = record.map_err(RunError::ReadBack)?;
        if let (Some(table), Some(set)) = (&mut sets, &record.set) {
            let place = |id: &str| record.entries.iter().find(|entry| entry.id == id)?.set.as_ref();
            table.add(&pair_rows(set, place))?;
        }
        for entry in record.entries {
            if interrupt::requested() {
                return Err(RunError::Interrupted(out.to_owned()));
            }
            let recording = read_back(from, &entry)?;
            if audited.len() < MAX_EVENTS {
                audited.push(AuditItem::of(&recording));
            }
            parquet.push(&entry, &recording)?;
            if let (Some(table), Some(row)) = (&mut videos, video_row(&entry)) {
                table.add(&row)?;
            }
            if let (Some(pages), Some(simulation)) = (&mut pages, &recording.simulation) {
                pages.push(entry, Timeline::of(&simulation.event))?;
            }
            progress.steps(1);
        }
    }
    overview.files = parquet.finish()?;
    if let Some(table) = sets {
        overview.files.push(table.file.commit()?);
    }
    overview.files.extend(pages.map_or_else(|| Ok(Vec::new()), GalleryWriter::finish)?);
    if let Some(table) = videos {
        overview.files.push(table.file.commit()?);
    }
    let shortcuts = shortcuts::section(audit(&audited, overview.events).as_ref(), overview.events);
    let text = card(&overview, command, &shortcuts);
    overview.files.push(measured::write(out, CARD_FILE, text.as_bytes())?);
    let text = croissant(&overview, card::about());
    overview.files.push(measured::write(out, CROISSANT_FILE, text.as_bytes())?);
    let digest = write_manifest(out, &overview, records)?;
    Ok(Completed { overview, digest })
}

/// Counts attempts and events.
fn count(whole: &DatasetDescription, records: &dyn Records) -> Result<Overview, RunError> {
    let mut overview = Overview::new(whole);
    let mut tally = Tally::default();
    for record in records.records() {
        let record = record.map_err(RunError::ReadBack)?;
        tally.add(record.entries.iter().filter_map(|entry| entry.variant), &record.refused);
        record.entries.iter().for_each(|entry| overview.count(entry));
        overview.sets += usize::from(record.set.is_some());
    }
    if whole.selected {
        overview.selection = tally.rows();
    }
    Ok(overview)
}

/// A file that does not belong to a single event, and is written line by line.
struct Table {
    file: MeasuredFile,
}

impl Table {
    fn create(out: &Path, name: &'static str, header: &str) -> Result<Self, RunError> {
        let mut table = Self { file: MeasuredFile::create(out, name)? };
        table.add(header)?;
        Ok(table)
    }

    fn add(&mut self, text: &str) -> Result<(), RunError> {
        self.file.write_all(text.as_bytes()).map_err(|source| self.file.failed(source).into())
    }
}

/// The event of an entry, from its file.
fn read_back(out: &Path, entry: &EventEntry) -> Result<Recording, RunError> {
    let file = entry.event.place(out);
    let recordings = phase_events::read(&file).map_err(RunError::ReadBack)?;
    let ours = |recording: &Recording| recording.simulation.is_some() && recording.id == entry.id;
    recordings.into_iter().find(ours).ok_or_else(|| {
        let rule = format!("it has no simulated event {}", entry.id);
        RunError::ReadBack(FileError { file, problem: Problem::Shape { what: "event of a dataset", rule } })
    })
}
