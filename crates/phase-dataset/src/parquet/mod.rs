//! A dataset's events as Parquet, one row per event, for pandas, `datasets` and other tools that read
//! columns.
//!
//! [`ParquetWriter`] writes them from the events one after the other, [`compare`] writes them again and
//! compares the bytes, and [`descriptions`] describes every column, as the dataset card does.
//!
//! Key design decision: a column's type is a Rust type. Nested lists of numbers determine both the file's
//! schema and its levels, without an intermediate array library, and comparing is writing without a file: no
//! reader has to be protected from what a damaged file declares. The trade-off is that only types known to
//! the module `cell` can be columns, and that a file is the same only for one version of the Parquet library.

mod cell;
mod column;
mod columns;
mod compare;
mod export;
mod row;
mod rows;
mod table;

pub use column::Description;
pub use columns::descriptions;
pub use compare::compare;
pub use export::ParquetWriter;
pub use table::{TableColumn, TableValues, VideoBytes, write_table};

use crate::{manifest::EventEntry, phase_events, splits::Split};
use phase_event::{EventReadError, Recording};
use phase_files::{FileError, Problem};
use phase_model::json::FieldError;
use row::Row;
use std::{collections::BTreeMap, path::Path};

/// Folder of the files within a dataset.
pub const FOLDER: &str = "data";
/// Maximum number of events in a file; more events make more files. With all columns that is about 200 MB.
pub const EVENTS_PER_FILE: usize = 5000;
/// Events that are written, and held in memory, at once.
const EVENTS_PER_GROUP: usize = 50;

/// One file of a dataset.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ParquetFile {
    /// Path relative to the dataset's folder, with `/`, such as `data/train-00000-of-00001.parquet`.
    pub path: String,
    /// The part of the dataset that the file holds.
    pub split: Split,
    /// Number of the file within its part, from 0.
    pub number: usize,
    /// Number of events in it, at least 1 and at most [`EVENTS_PER_FILE`].
    pub events: usize,
}

impl ParquetFile {
    /// Its events, in order, out of those of the dataset.
    #[must_use]
    pub fn of<'a>(&self, events: &'a [EventEntry]) -> Vec<&'a EventEntry> {
        let same = events.iter().filter(|event| event.split() == self.split);
        same.skip(self.number * EVENTS_PER_FILE).take(self.events).collect()
    }
}

/// The files that a dataset's events go to, given the number of events in each part: by split, and in the
/// dataset's order within it.
#[must_use]
pub fn parts(splits: &BTreeMap<Split, usize>) -> Vec<ParquetFile> {
    let mut parts = Vec::new();
    for (&split, &count) in splits {
        let files = count.div_ceil(EVENTS_PER_FILE);
        parts.extend((0..files).map(|number| ParquetFile {
            path: format!("{FOLDER}/{}-{number:05}-of-{files:05}.parquet", split.name()),
            split,
            number,
            events: (count - number * EVENTS_PER_FILE).min(EVENTS_PER_FILE),
        }));
    }
    parts
}

/// Reads the event of an entry.
pub(crate) fn read(folder: &Path, entry: &EventEntry) -> Result<Recording, FileError> {
    let file = entry.event.place(folder);
    let recordings = phase_events::read(&file)?;
    let count = recordings.len();
    match <[Recording; 1]>::try_from(recordings) {
        Ok([recording]) => Ok(recording),
        Err(_) => Err(not_whole(file, None, "events", format!("must hold one event, not {count}"))),
    }
}

/// The row of an event, which has to be simulated.
fn row_of<'a>(folder: &Path, entry: &'a EventEntry, recording: &'a Recording) -> Result<Row<'a>, FileError> {
    match &recording.simulation {
        Some(simulation) => Ok(Row { entry, recording, simulation }),
        None => {
            let file = entry.event.place(folder);
            Err(not_whole(file, Some(&recording.id), "substeps", "is missing".into()))
        }
    }
}

fn not_whole(file: std::path::PathBuf, event: Option<&str>, field: &str, rule: String) -> FileError {
    let problem = FieldError { field: field.into(), rule };
    let problem = EventReadError::Field { event: event.map(String::from), problem };
    FileError { file, problem: Problem::content(problem) }
}
