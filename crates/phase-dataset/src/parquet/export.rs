//! Writing.

use super::{EVENTS_PER_GROUP, FOLDER, ParquetFile, column::Column, columns, parts, push, schema};
use crate::{ExportError, manifest::EventEntry, splits::Split};
use parquet::{
    basic::{Compression, Encoding, ZstdLevel},
    errors::{ParquetError, Result},
    file::{
        properties::{EnabledStatistics, WriterProperties},
        writer::SerializedFileWriter,
    },
};
use phase_event::Recording;
use phase_files::{FileError, Problem, WriteError, atomic::AtomicFile, checksum::FileEntry};
use std::{
    collections::BTreeMap,
    fs, io,
    path::{Path, PathBuf},
    sync::Arc,
};

/// Compression level, from 1 to 22; higher levels gain nothing on these columns.
const EFFORT: i32 = 9;

/// A dataset's Parquet files while they are written, one for each part of the dataset at a time; the events of one row group
/// of each are in memory. The same events give the same bytes.
pub struct ParquetWriter<'a> {
    folder: &'a Path,
    /// Files not begun yet, by part; the last is the next.
    waiting: BTreeMap<Split, Vec<ParquetFile>>,
    /// The file of each part that is being written.
    open: BTreeMap<Split, OpenFile>,
    /// Those that are complete.
    complete: Vec<FileEntry>,
    order: Vec<String>,
}

/// A file that is being written.
struct OpenFile {
    path: PathBuf,
    name: String,
    writer: SerializedFileWriter<AtomicFile>,
    columns: Vec<Box<dyn Column>>,
    /// Events that are not written yet.
    held: usize,
    /// Events to come.
    left: usize,
}

impl<'a> ParquetWriter<'a> {
    /// Prepares to write the files of a dataset with the given number of events in each part.
    ///
    /// # Errors
    /// If their folder cannot be created.
    pub fn new(folder: &'a Path, splits: &BTreeMap<Split, usize>) -> std::result::Result<Self, WriteError> {
        let data = folder.join(FOLDER);
        fs::create_dir_all(&data).map_err(|source| WriteError {
            path: data,
            action: "create the folder",
            source,
        })?;
        let parts = parts(splits);
        let order = parts.iter().map(|part| part.path.clone()).collect();
        let mut waiting: BTreeMap<Split, Vec<ParquetFile>> = BTreeMap::new();
        for part in parts.into_iter().rev() {
            waiting.entry(part.split).or_default().push(part);
        }
        Ok(Self { folder, waiting, open: BTreeMap::new(), complete: Vec::new(), order })
    }

    /// Adds the dataset's next event.
    ///
    /// # Errors
    /// If it was not simulated, or was not counted when the files were prepared; if a file cannot be written.
    pub fn push(
        &mut self,
        entry: &EventEntry,
        recording: &Recording,
    ) -> std::result::Result<(), ExportError> {
        let split = entry.split();
        let mut file = match self.open.remove(&split) {
            Some(file) => file,
            None => {
                let next = self.waiting.get_mut(&split).and_then(Vec::pop);
                let uncounted = || {
                    let problem = Problem::Shape {
                        what: "dataset",
                        rule: format!("there are more {} events than were counted", split.name()),
                    };
                    FileError { file: entry.event.place(self.folder), problem }
                };
                OpenFile::create(self.folder, &next.ok_or_else(uncounted)?)?
            }
        };
        push(&mut file.columns, self.folder, entry, recording)?;
        (file.held, file.left) = (file.held + 1, file.left - 1);
        if file.held == EVENTS_PER_GROUP || file.left == 0 {
            file.write_group()?;
        }
        if file.left == 0 {
            self.complete.push(file.finish(self.folder)?);
        } else {
            self.open.insert(split, file);
        }
        Ok(())
    }

    /// Describes the files, in the order of [`parts`].
    ///
    /// # Errors
    /// If fewer events were added than were counted when the files were prepared.
    pub fn finish(mut self) -> std::result::Result<Vec<FileEntry>, ExportError> {
        if let Some((_, file)) = self.open.first_key_value() {
            let rule = format!("{} events are missing", file.left);
            let problem = Problem::Shape { what: "Parquet file", rule };
            return Err(FileError { file: file.path.clone(), problem }.into());
        }
        let place = |file: &FileEntry| self.order.iter().position(|path| *path == file.path.as_str());
        self.complete.sort_by_key(place);
        Ok(self.complete)
    }
}

impl OpenFile {
    fn create(folder: &Path, part: &ParquetFile) -> std::result::Result<Self, WriteError> {
        let path = folder.join(&part.path);
        let columns = columns::all();
        let properties = properties(&columns).map_err(|error| failed(&path, error))?;
        let schema = schema(&columns).map_err(|error| failed(&path, error))?;
        let file = AtomicFile::create(&path)?;
        let writer = SerializedFileWriter::new(file, schema, Arc::new(properties));
        let writer = writer.map_err(|error| failed(&path, error))?;
        Ok(Self { path, name: part.path.clone(), writer, columns, held: 0, left: part.events })
    }

    fn write_group(&mut self) -> std::result::Result<(), WriteError> {
        self.held = 0;
        write_group(&mut self.writer, &mut self.columns).map_err(|error| failed(&self.path, error))
    }

    fn finish(self, folder: &Path) -> std::result::Result<FileEntry, ExportError> {
        let file = self.writer.into_inner().map_err(|error| failed(&self.path, error))?;
        file.commit()?;
        Ok(FileEntry::of(folder, self.name)?)
    }
}

fn failed(path: &Path, error: ParquetError) -> WriteError {
    WriteError {
        path: path.to_owned(),
        action: "write the file",
        source: match error {
            ParquetError::External(inner) => io::Error::other(inner),
            other => io::Error::other(other),
        },
    }
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
