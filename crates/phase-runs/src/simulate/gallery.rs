//! The page on which simulated events can be watched, as those of a dataset can.

use crate::{engine::GENERATOR, error::RunError, gallery_writer::GalleryWriter};
use phase_dataset::{manifest::EventEntry, summary::EventComparison};
use phase_event::Event;
use phase_report::gallery::{Gallery, Timeline};
use std::path::Path;

/// Parts of one event that the page shows.
#[derive(Debug)]
pub(super) struct Shown {
    entry: EventEntry,
    timeline: Timeline,
}

impl Shown {
    /// For an event whose files are already described.
    pub(super) fn of(comparison: &EventComparison, event: &Event) -> Self {
        let EventComparison { id, event: json, video, .. } = comparison;
        let entry = EventEntry::with_files(id, event, json.clone(), video.clone());
        Self { entry, timeline: Timeline::of(event) }
    }
}

/// Writes the page into the folder of the events.
pub(super) fn write(out: &Path, seed: u64, shown: Vec<Shown>) -> Result<(), RunError> {
    let (preset, generator, events) = ("simulated scenes", GENERATOR, shown.len());
    let gallery = Gallery { preset, generator, seed, events, overlay: None };
    let mut writer = GalleryWriter::new(out, gallery);
    for Shown { entry, timeline } in shown {
        writer.push(entry, timeline)?;
    }
    writer.finish().map(|_| ())
}
