//! What a Parquet file declares, compared with its size and its contents before it is read: the library reserves as much memory
//! as a file asks for.

use super::thrift::{Reader, Result};
use parquet::file::metadata::ColumnChunkMetaData;
use std::{
    fs::File,
    io::{Read, Seek, SeekFrom},
};

/// Largest page (bytes, uncompressed). The writer begins a new one after 1 MiB.
const LARGEST_PAGE: i64 = 16 << 20;
/// Values that a column may have beyond those it should have, so that a difference is found by comparison.
const FURTHER_VALUES: i64 = 1_000_000;
/// Bytes at the end of a file: the length of its description and four letters.
const TAIL: u64 = 8;

/// Fields of the description of a page.
mod field {
    pub(super) const UNCOMPRESSED: [u16; 1] = [2];
    pub(super) const COMPRESSED: [u16; 1] = [3];
    /// Number of values, of a page of data (both versions) and of a dictionary.
    pub(super) const VALUES: [[u16; 2]; 3] = [[5, 1], [8, 1], [7, 1]];
}

/// Checks that the description at the end of a file lies in the file, and each of its lists in the description.
///
/// # Errors
/// The rule that is violated.
pub(super) fn check_description(file: &mut File) -> Result<()> {
    let length = file.metadata().map_err(|error| error.to_string())?.len();
    let tail = bytes(file, length.saturating_sub(TAIL), TAIL)?;
    let Some((count, _)) = tail.split_first_chunk() else { return Err("it is too short".into()) };
    let count = u64::from(u32::from_le_bytes(*count));
    let begins = length.saturating_sub(TAIL).checked_sub(count);
    let begins = begins.ok_or_else(|| format!("it describes itself in {count} bytes, but has {length}"))?;
    Reader::new(&bytes(file, begins, count)?).structure(&mut |_, _| {})
}

/// Checks the pages of a column: they lie in the file, none is larger than the writer's ever are, and together they have about as
/// many values as they should.
///
/// # Errors
/// The rule that is violated.
pub(super) fn check_pages(file: &mut File, column: &ColumnChunkMetaData, values: usize) -> Result<()> {
    let data = column.data_page_offset();
    let begins = column.dictionary_page_offset().map_or(data, |dictionary| dictionary.min(data));
    let length = file.metadata().map_err(|error| error.to_string())?.len();
    let place = u64::try_from(begins).ok().zip(u64::try_from(column.compressed_size()).ok());
    let place = place.filter(|(begins, count)| begins.checked_add(*count).is_some_and(|end| end <= length));
    let (begins, count) = place.ok_or("it has a column outside of itself")?;
    let chunk = bytes(file, begins, count)?;
    let (mut at, mut left) = (0, i64::try_from(values).unwrap_or(i64::MAX).saturating_add(FURTHER_VALUES));
    while at < chunk.len() {
        let mut page = Reader::new(&chunk[at..]);
        let (mut uncompressed, mut compressed, mut count) = (0, 0, 0);
        page.structure(&mut |path, number| {
            if path == field::UNCOMPRESSED {
                uncompressed = number;
            } else if path == field::COMPRESSED {
                compressed = number;
            } else if field::VALUES.iter().any(|field| field == path) {
                count = number;
            }
        })?;
        if !(0..=LARGEST_PAGE).contains(&uncompressed) {
            return Err(format!(
                "it declares a page of {uncompressed} bytes, and none has more than {LARGEST_PAGE}"
            ));
        }
        left -= count;
        if count < 0 || left < 0 {
            return Err(format!("it declares many more values than the {values} of its events"));
        }
        at += page.position();
        let room = (chunk.len() - at) as i64;
        if !(0..=room).contains(&compressed) {
            return Err(format!("it declares a page of {compressed} bytes in a column with {room} left"));
        }
        at += compressed as usize;
    }
    Ok(())
}

fn bytes(file: &mut File, begins: u64, count: u64) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let read = file.seek(SeekFrom::Start(begins)).and_then(|_| file.take(count).read_to_end(&mut bytes));
    match read {
        Ok(read) if read as u64 == count => Ok(bytes),
        Ok(_) => Err("it ends too early".into()),
        Err(error) => Err(error.to_string()),
    }
}
