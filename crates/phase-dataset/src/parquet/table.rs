//! Small tables of texts, numbers and videos, as Hugging Face reads them.

use super::rows::io_error;
use parquet::{
    basic::{Compression, Encoding, ZstdLevel},
    data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type},
    errors::Result,
    file::{
        metadata::KeyValue,
        properties::WriterProperties,
        writer::{SerializedFileWriter, SerializedRowGroupWriter},
    },
    schema::parser::parse_message_type,
};
use serde_json::{Value, json};
use std::{io, io::Write, sync::Arc};

/// A column of a table.
#[derive(Clone, Debug)]
pub struct TableColumn {
    /// Its name.
    pub name: &'static str,
    /// One value a row.
    pub values: TableValues,
}

/// The values of a column.
#[derive(Clone, Debug)]
pub enum TableValues {
    /// Texts.
    Texts(Vec<String>),
    /// Whole numbers.
    Numbers(Vec<i64>),
    /// Numbers.
    Reals(Vec<f64>),
    /// Classes, as indices of these names.
    Classes(Vec<String>, Vec<i64>),
    /// Lists of texts.
    TextLists(Vec<Vec<String>>),
    /// Lists of numbers.
    RealLists(Vec<Vec<f64>>),
    /// Videos: name and content of each file.
    Videos(Vec<(String, ByteArray)>),
}

/// The content of a video, which many rows can share.
pub type VideoBytes = ByteArray;

/// Compression level.
const EFFORT: i32 = 3;
/// Largest set of different values of a column in a row group (bytes): a video is stored once, however many
/// rows show it.
const DICTIONARY: usize = 1 << 30;

/// Writes a table with the description of its columns that the library `datasets` reads. Rows are written in
/// groups of this number.
///
/// # Errors
/// If it cannot be written.
pub fn write_table<W: Write + Send>(out: W, columns: &[TableColumn], rows_per_group: usize) -> io::Result<W> {
    write(out, columns, rows_per_group).map_err(io_error)
}

fn write<W: Write + Send>(out: W, columns: &[TableColumn], rows_per_group: usize) -> Result<W> {
    let fields: String = columns.iter().map(schema).collect();
    let schema = Arc::new(parse_message_type(&format!("message schema {{ {fields} }}"))?);
    let features: serde_json::Map<String, Value> =
        columns.iter().map(|column| (column.name.to_owned(), feature(&column.values))).collect();
    let about = json!({ "info": { "features": features } }).to_string();
    let properties = WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::try_new(EFFORT)?))
        .set_encoding(Encoding::PLAIN)
        .set_dictionary_enabled(true)
        .set_dictionary_page_size_limit(DICTIONARY)
        .set_key_value_metadata(Some(vec![KeyValue::new("huggingface".to_owned(), about)]))
        .build();
    let mut writer = SerializedFileWriter::new(out, schema, Arc::new(properties))?;
    let rows = columns.first().map_or(0, |column| column.values.len());
    for first in (0..rows).step_by(rows_per_group.max(1)) {
        let range = first..(first + rows_per_group.max(1)).min(rows);
        let mut group = writer.next_row_group()?;
        for column in columns {
            write_column(&mut group, &column.values, range.clone())?;
        }
        group.close()?;
    }
    writer.into_inner()
}

impl TableValues {
    const fn len(&self) -> usize {
        match self {
            Self::Texts(values) => values.len(),
            Self::Numbers(values) | Self::Classes(_, values) => values.len(),
            Self::Reals(values) => values.len(),
            Self::TextLists(values) => values.len(),
            Self::RealLists(values) => values.len(),
            Self::Videos(values) => values.len(),
        }
    }
}

fn schema(column: &TableColumn) -> String {
    let name = column.name;
    let list = |element: &str| {
        format!("required group {name} (LIST) {{ repeated group list {{ required {element}; }} }} ")
    };
    match column.values {
        TableValues::Texts(_) => format!("required binary {name} (STRING); "),
        TableValues::Numbers(_) => format!("required int64 {name}; "),
        // `datasets` takes its description of a column for that of the file only where values may be missing.
        TableValues::Classes(..) => format!("optional int64 {name}; "),
        TableValues::Reals(_) => format!("required double {name}; "),
        TableValues::TextLists(_) => list("binary element (STRING)"),
        TableValues::RealLists(_) => list("double element"),
        TableValues::Videos(_) => {
            format!("optional group {name} {{ optional binary bytes; optional binary path (STRING); }} ")
        }
    }
}

/// The description of a column, as `datasets` writes it.
fn feature(values: &TableValues) -> Value {
    let value = |kind: &str| json!({ "dtype": kind, "_type": "Value" });
    match values {
        TableValues::Texts(_) => value("string"),
        TableValues::Numbers(_) => value("int64"),
        TableValues::Reals(_) => value("float64"),
        TableValues::Classes(names, _) => json!({ "names": names, "_type": "ClassLabel" }),
        TableValues::TextLists(_) => json!({ "feature": value("string"), "_type": "List" }),
        TableValues::RealLists(_) => json!({ "feature": value("float64"), "_type": "List" }),
        TableValues::Videos(_) => json!({ "_type": "Video" }),
    }
}

fn write_column<W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: &TableValues,
    range: core::ops::Range<usize>,
) -> Result<()> {
    let text = |text: &String| ByteArray::from(text.as_bytes().to_vec());
    match values {
        TableValues::Texts(all) => {
            texts(group, &all[range].iter().map(text).collect::<Vec<_>>(), None)?;
        }
        TableValues::Numbers(all) | TableValues::Classes(_, all) => {
            if let Some(mut column) = group.next_column()? {
                let present = vec![1; range.len()];
                let definition = matches!(values, TableValues::Classes(..)).then_some(&present[..]);
                column.typed::<Int64Type>().write_batch(&all[range], definition, None)?;
                column.close()?;
            }
        }
        TableValues::Reals(all) => {
            if let Some(mut column) = group.next_column()? {
                column.typed::<DoubleType>().write_batch(&all[range], None, None)?;
                column.close()?;
            }
        }
        TableValues::TextLists(all) => {
            let flat: Vec<ByteArray> = all[range.clone()].iter().flatten().map(text).collect();
            texts(group, &flat, Some(levels(all[range].iter().map(Vec::len))))?;
        }
        TableValues::RealLists(all) => {
            let flat: Vec<f64> = all[range.clone()].iter().flatten().copied().collect();
            let (definition, repetition) = levels(all[range].iter().map(Vec::len));
            if let Some(mut column) = group.next_column()? {
                column.typed::<DoubleType>().write_batch(&flat, Some(&definition), Some(&repetition))?;
                column.close()?;
            }
        }
        TableValues::Videos(all) => {
            let bytes: Vec<ByteArray> = all[range.clone()].iter().map(|(_, bytes)| bytes.clone()).collect();
            let names: Vec<ByteArray> = all[range].iter().map(|(name, _)| text(name)).collect();
            let present = || Some((vec![2; names.len()], Vec::new()));
            texts(group, &bytes, present())?;
            texts(group, &names, present())?;
        }
    }
    Ok(())
}

/// Definition levels, and repetition levels, of which there are none outside of lists.
type Levels = (Vec<i16>, Vec<i16>);

fn texts<W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: &[ByteArray],
    levels: Option<Levels>,
) -> Result<()> {
    let Some(mut column) = group.next_column()? else { return Ok(()) };
    let (definition, repetition) = match &levels {
        Some((definition, repetition)) if repetition.is_empty() => (Some(&definition[..]), None),
        Some((definition, repetition)) => (Some(&definition[..]), Some(&repetition[..])),
        None => (None, None),
    };
    column.typed::<ByteArrayType>().write_batch(values, definition, repetition)?;
    column.close()
}

/// Definition and repetition levels of lists of these lengths.
fn levels(lengths: impl Iterator<Item = usize>) -> Levels {
    let mut levels = Levels::default();
    for length in lengths {
        levels.0.extend(core::iter::repeat_n(i16::from(length > 0), length.max(1)));
        levels.1.extend((0..length.max(1)).map(|k| i16::from(k > 0)));
    }
    levels
}
