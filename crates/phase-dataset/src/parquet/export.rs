//! Writing.

use super::{EVENTS_PER_GROUP, FOLDER, ParquetFile, column::Column, columns, parts, push, read, schema};
use crate::{FileError, WriteError, atomic::AtomicFile, checksum::FileEntry, manifest::EventEntry};
use parquet::{
    basic::{Compression, Encoding, ZstdLevel},
    errors::{ParquetError, Result},
    file::{
        properties::{EnabledStatistics, WriterProperties},
        writer::SerializedFileWriter,
    },
};
use std::{fs, io, path::Path, sync::Arc};
use thiserror::Error;

/// Compression level, from 1 to 22; higher levels gain nothing on these columns.
const EFFORT: i32 = 9;

/// Why Parquet files were not written.
#[derive(Debug, Error)]
pub enum ExportError {
    /// An event file cannot be read back.
    #[error(transparent)]
    Read(#[from] FileError),
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// Writes a dataset's Parquet files from its event files, which are read one after the other, and describes
/// them. The same events give the same bytes. `interrupted` is called between events; `None` if it returned
/// true, in which case complete files are kept.
///
/// # Errors
/// [`ExportError`].
pub fn export(
    folder: &Path,
    events: &[EventEntry],
    interrupted: &dyn Fn() -> bool,
) -> std::result::Result<Option<Vec<FileEntry>>, ExportError> {
    let data = folder.join(FOLDER);
    let failed = |source| WriteError { path: data.clone(), action: "create the folder", source };
    fs::create_dir_all(&data).map_err(failed)?;
    let mut files = Vec::new();
    for part in parts(events) {
        if !write(folder, &part, interrupted)? {
            return Ok(None);
        }
        files.push(FileEntry::of(folder, part.path)?);
    }
    Ok(Some(files))
}

/// Writes one file; false if it was interrupted.
fn write(
    folder: &Path,
    part: &ParquetFile<'_>,
    interrupted: &dyn Fn() -> bool,
) -> std::result::Result<bool, ExportError> {
    let path = folder.join(&part.path);
    let failed = |error: ParquetError| WriteError {
        path: path.clone(),
        action: "write the file",
        source: match error {
            ParquetError::External(inner) => io::Error::other(inner),
            other => io::Error::other(other),
        },
    };
    let mut columns = columns::all();
    let properties = properties(&columns).map_err(failed)?;
    let schema = schema(&columns).map_err(failed)?;
    let file = AtomicFile::create(&path)?;
    let mut writer = SerializedFileWriter::new(file, schema, Arc::new(properties)).map_err(failed)?;
    for events in part.events.chunks(EVENTS_PER_GROUP) {
        for entry in events {
            if interrupted() {
                return Ok(false);
            }
            push(&mut columns, folder, entry, &read(folder, entry)?)?;
        }
        write_group(&mut writer, &mut columns).map_err(failed)?;
    }
    let file = writer.into_inner().map_err(failed)?;
    file.commit()?;
    Ok(true)
}

fn write_group(writer: &mut SerializedFileWriter<AtomicFile>, columns: &mut [Box<dyn Column>]) -> Result<()> {
    let mut group = writer.next_row_group()?;
    for column in columns {
        if let Some(mut place) = group.next_column()? {
            column.flush(&mut place)?;
            place.close()?;
        }
    }
    group.close()?;
    Ok(())
}

fn properties(columns: &[Box<dyn Column>]) -> Result<WriterProperties> {
    let mut properties = WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::try_new(EFFORT)?))
        .set_statistics_enabled(EnabledStatistics::Chunk);
    for path in columns.iter().filter_map(|column| column.floating_path()) {
        // Values hardly repeat, but their first bytes do.
        properties = properties
            .set_column_dictionary_enabled(path.clone(), false)
            .set_column_encoding(path, Encoding::BYTE_STREAM_SPLIT);
    }
    Ok(properties.build())
}
