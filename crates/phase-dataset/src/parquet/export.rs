//! Writing the files of a dataset.

use super::{
    FOLDER, ParquetFile, parts, row_of,
    rows::{Rows, io_error},
};
use crate::{ExportError, manifest::EventEntry, splits::Split};
use parquet::errors::ParquetError;
use phase_event::Recording;
use phase_files::{FileError, Problem, WriteError, checksum::FileEntry, measured::MeasuredFile};
use std::{collections::BTreeMap, fs, path::Path};

/// A dataset's Parquet files while they are written, one for each part of the dataset at a time; the events
/// of one row group of each are in memory. The same events give the same bytes.
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
    path: std::path::PathBuf,
    rows: Rows<MeasuredFile>,
}

impl<'a> ParquetWriter<'a> {
    /// Prepares to write the files of a dataset with the given number of events in each part.
    ///
    /// # Errors
    /// If their folder cannot be created.
    pub fn new(folder: &'a Path, splits: &BTreeMap<Split, usize>) -> Result<Self, WriteError> {
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
    pub fn push(&mut self, entry: &EventEntry, recording: &Recording) -> Result<(), ExportError> {
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
        let row = row_of(self.folder, entry, recording)?;
        file.rows.push(&row).map_err(|error| file.failed(error))?;
        if file.rows.left() == 0 {
            self.complete.push(file.finish()?);
        } else {
            self.open.insert(split, file);
        }
        Ok(())
    }

    /// Describes the files, in the order of [`parts`].
    ///
    /// # Errors
    /// If fewer events were added than were counted when the files were prepared.
    pub fn finish(mut self) -> Result<Vec<FileEntry>, ExportError> {
        if let Some((_, file)) = self.open.first_key_value() {
            let rule = format!("{} events are missing", file.rows.left());
            let problem = Problem::Shape { what: "Parquet file", rule };
            return Err(FileError { file: file.path.clone(), problem }.into());
        }
        let place = |file: &FileEntry| self.order.iter().position(|path| *path == file.path.as_str());
        self.complete.sort_by_key(place);
        Ok(self.complete)
    }
}

impl OpenFile {
    fn create(folder: &Path, part: &ParquetFile) -> Result<Self, WriteError> {
        let path = folder.join(&part.path);
        let file = MeasuredFile::create(folder, part.path.as_str())?;
        match Rows::new(file, part.events) {
            Ok(rows) => Ok(Self { path, rows }),
            Err(error) => Err(failed(&path, error)),
        }
    }

    fn failed(&self, error: ParquetError) -> WriteError {
        failed(&self.path, error)
    }

    fn finish(self) -> Result<FileEntry, WriteError> {
        let Self { path, rows } = self;
        rows.finish().map_err(|error| failed(&path, error))?.commit()
    }
}

fn failed(path: &Path, error: ParquetError) -> WriteError {
    WriteError { path: path.to_owned(), action: "write the file", source: io_error(error) }
}
