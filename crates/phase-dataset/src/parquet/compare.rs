//! Checking that a file still agrees with the event files.

use super::{
    EVENTS_PER_GROUP, ParquetFile, columns,
    declared::{check_description, check_pages},
    push, read, schema,
};
use crate::DatasetProblem;
use crate::manifest::EventEntry;
use parquet::{
    errors::ParquetError,
    file::reader::{FileReader, SerializedFileReader},
};
use phase_files::{FileError, Problem};
use std::{
    fs::File,
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
};

/// Compares a Parquet file with the event files it was made from, column by column. `events` are its events, in order.
///
/// # Errors
/// If a file cannot be read, if the Parquet file has other columns or another number of rows, or if a value in it
/// differs; then the event and the column are named.
pub fn compare(folder: &Path, part: &ParquetFile, events: &[&EventEntry]) -> Result<(), FileError> {
    (0..shares(part)).try_for_each(|share| compare_share(folder, part, events, share))
}

/// Number of shares, about a row group each, into which the comparison of a file is divided.
pub(crate) fn shares(part: &ParquetFile) -> usize {
    part.events.div_ceil(EVENTS_PER_GROUP)
}

/// One share of [`compare`]; all of them together are the whole, however the file is divided into row groups.
///
/// # Errors
/// As [`compare`]; problems of the whole file are reported in every share.
pub(crate) fn compare_share(
    folder: &Path,
    part: &ParquetFile,
    events: &[&EventEntry],
    share: usize,
) -> Result<(), FileError> {
    // The library panics on some files that were damaged on purpose; no state that it has touched is used
    // afterwards.
    catch_unwind(AssertUnwindSafe(|| compare_columns(folder, part, events, share))).unwrap_or_else(|_| {
        Err(FileError { file: folder.join(&part.path), problem: DatasetProblem::ParquetPages.into() })
    })
}

fn compare_columns(
    folder: &Path,
    part: &ParquetFile,
    events: &[&EventEntry],
    share: usize,
) -> Result<(), FileError> {
    let path = folder.join(&part.path);
    let fail = |problem| FileError { file: path.clone(), problem };
    let broken = |error: ParquetError| fail(DatasetProblem::Parquet(error.into()).into());
    let unfit = |rule| fail(Problem::Shape { what: "Parquet file", rule });
    let open = || File::open(&path).map_err(|error| fail(Problem::Unreadable(error)));
    let (mut pages, file) = (open()?, open()?);
    check_description(&mut pages).map_err(unfit)?;
    let reader = SerializedFileReader::new(file).map_err(broken)?;
    let mut columns = columns::all();
    let expected = schema(&columns).map_err(broken)?;
    let about = reader.metadata().file_metadata();
    if about.schema() != expected.as_ref() {
        return Err(fail(Problem::Shape { what: "Parquet file", rule: "its columns are others".into() }));
    }
    let other_count = |found: &dyn core::fmt::Display| {
        let rule = format!("it holds {found} events instead of {}", events.len());
        fail(Problem::Shape { what: "Parquet file", rule })
    };
    if usize::try_from(about.num_rows()) != Ok(events.len()) {
        return Err(other_count(&about.num_rows()));
    }
    let mut first = 0;
    for k in 0..reader.num_row_groups() {
        let group = reader.get_row_group(k).map_err(broken)?;
        let count = usize::try_from(group.metadata().num_rows()).unwrap_or_default();
        if k % shares(part) != share {
            first += count;
            continue;
        }
        for entry in events.iter().skip(first).take(count) {
            push(&mut columns, folder, entry, &read(folder, entry)?)?;
        }
        for (c, column) in columns.iter_mut().enumerate() {
            check_pages(&mut pages, group.metadata().column(c), column.levels()).map_err(unfit)?;
            let reader = group.get_column_reader(c).map_err(broken)?;
            if let Some(event) = column.compare(reader).map_err(broken)? {
                let event = events.get(first + event).map_or_else(String::new, |entry| entry.id.clone());
                return Err(fail(
                    DatasetProblem::Disagrees { event, column: column.description().name }.into(),
                ));
            }
        }
        first += count;
    }
    if first == events.len() { Ok(()) } else { Err(other_count(&first)) }
}
