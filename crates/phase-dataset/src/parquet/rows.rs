//! Rows of events, written to anything: a file, or a comparison with one.

use super::{
    EVENTS_PER_GROUP,
    column::{self, Column},
    columns,
    row::Row,
};
use parquet::{
    basic::{Compression, Encoding, ZstdLevel},
    errors::{ParquetError, Result},
    file::{
        properties::{EnabledStatistics, WriterProperties},
        writer::SerializedFileWriter,
    },
};
use std::{
    io::{self, Write},
    sync::Arc,
};

/// Compression level, from 1 to 22; higher levels gain nothing on these columns.
const EFFORT: i32 = 9;

/// The rows of one Parquet file. The same events give the same bytes; one row group is in memory.
pub(super) struct Rows<W: Write + Send> {
    writer: SerializedFileWriter<W>,
    columns: Vec<Box<dyn Column>>,
    /// Events that are not written yet.
    held: usize,
    /// Events to come.
    left: usize,
}

impl<W: Write + Send> Rows<W> {
    /// A file of `events` events.
    pub(super) fn new(out: W, events: usize) -> Result<Self> {
        let columns = columns::all();
        let properties = Arc::new(properties(&columns)?);
        let writer = SerializedFileWriter::new(out, column::schema(&columns)?, properties)?;
        Ok(Self { writer, columns, held: 0, left: events })
    }

    /// Adds an event, and writes the row group that it completes.
    pub(super) fn push(&mut self, row: &Row<'_>) -> Result<()> {
        self.columns.iter_mut().for_each(|column| column.push(row));
        self.held += 1;
        self.left -= 1;
        if self.held < EVENTS_PER_GROUP && self.left > 0 {
            return Ok(());
        }
        self.held = 0;
        let mut group = self.writer.next_row_group()?;
        for column in &mut self.columns {
            if let Some(mut place) = group.next_column()? {
                column.flush(&mut place)?;
                place.close()?;
            }
        }
        group.close()?;
        Ok(())
    }

    /// Number of events to come.
    pub(super) const fn left(&self) -> usize {
        self.left
    }

    /// The writer that the rows go to.
    pub(super) fn out(&self) -> &W {
        self.writer.inner()
    }

    /// Writes the description at the end.
    pub(super) fn finish(self) -> Result<W> {
        self.writer.into_inner()
    }
}

/// The error of the system behind one of the library, if there is one.
pub(super) fn io_error(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(inner) => io::Error::other(inner),
        other => io::Error::other(other),
    }
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
