//! Checking that a file still agrees with the event files.

use super::{
    ParquetFile, read, row_of,
    rows::{Rows, io_error},
};
use crate::manifest::EventEntry;
use parquet::errors::ParquetError;
use phase_files::{FileError, Problem, regular};
use std::{
    fs::File,
    io::{self, BufReader, Read, Write},
    path::Path,
};

/// Writes a Parquet file again from the event files it was made from, and compares the bytes. `events` are
/// its events, in order. No byte of the file is interpreted: whatever it holds, one row group of events is in
/// memory.
///
/// # Errors
/// If a file cannot be read, or if the Parquet file has other bytes than its events give.
pub fn compare(folder: &Path, part: &ParquetFile, events: &[&EventEntry]) -> Result<(), FileError> {
    let path = folder.join(&part.path);
    let fail = |problem| FileError { file: path.clone(), problem };
    let unwritten = |error: ParquetError| fail(Problem::Unreadable(io_error(error)));
    let differs = || fail(Problem::Differs("what PHASE writes for its events".into()));
    if events.len() != part.events {
        return Err(differs());
    }
    let file = regular::open(&path)?;
    let mut rows = Rows::new(Comparison::with(file), events.len()).map_err(unwritten)?;
    for entry in events {
        let recording = read(folder, entry)?;
        rows.push(&row_of(folder, entry, &recording)?).map_err(unwritten)?;
        if rows.out().differs {
            return Err(differs());
        }
    }
    let is_same =
        rows.finish().map_err(unwritten)?.agrees().map_err(|error| fail(Problem::Unreadable(error)))?;
    if is_same { Ok(()) } else { Err(differs()) }
}

/// A writer that compares the bytes it is given with a file, from the file's beginning.
struct Comparison {
    file: BufReader<File>,
    buffer: Vec<u8>,
    differs: bool,
}

impl Comparison {
    fn with(file: File) -> Self {
        Self { file: BufReader::new(file), buffer: Vec::new(), differs: false }
    }

    /// Whether the file holds what was written and no more.
    fn agrees(mut self) -> io::Result<bool> {
        Ok(!self.differs && self.file.read(&mut [0])? == 0)
    }
}

impl Write for Comparison {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.buffer.resize(bytes.len(), 0);
        match self.file.read_exact(&mut self.buffer) {
            Ok(()) => self.differs |= self.buffer != bytes,
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => self.differs = true,
            Err(error) => return Err(error),
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
