//! The page on which simulated events can be watched, as those of a dataset can.

use crate::{engine::GENERATOR, error::CliError};
use phase_dataset::{
    atomic,
    manifest::{DATASET_FORMAT, EventEntry, Manifest, PAGE_FILE},
    summary::EventComparison,
};
use phase_event::Event;
use phase_report::gallery::{Timeline, page};
use serde_json::Value;
use std::path::Path;

/// What the page shows of one event.
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
///
/// # Errors
/// [`CliError::Write`].
pub(super) fn write(out: &Path, seed: u64, shown: Vec<Shown>) -> Result<(), CliError> {
    let (events, timelines): (Vec<_>, Vec<_>) =
        shown.into_iter().map(|shown| (shown.entry, shown.timeline)).unzip();
    let manifest = Manifest {
        format: DATASET_FORMAT.into(),
        generator: GENERATOR.into(),
        preset: "simulated scenes".into(),
        seed,
        settings: Value::Null,
        selection: Vec::new(),
        sets: Vec::new(),
        events,
        files: Vec::new(),
    };
    Ok(atomic::write(&out.join(PAGE_FILE), page(&manifest, &timelines).as_bytes())?)
}
