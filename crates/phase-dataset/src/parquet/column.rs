//! A column: its description for people, its schema, and the values of the current row group.

use super::{
    cell::{Cell, Leaves},
    row::Row,
};
use parquet::{
    column::reader::{ColumnReader, get_typed_column_reader},
    data_type::DataType,
    errors::Result,
    file::writer::SerializedColumnWriter,
    schema::types::{ColumnPath, Type},
};

/// What a column holds, for people.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Description {
    /// Name.
    pub name: &'static str,
    /// Shape in numpy's sense, such as `[steps, 2]`; empty for a single value.
    pub shape: &'static str,
    /// Type of the single values, in numpy's words; `string` for texts.
    pub kind: &'static str,
    /// Unit, or empty.
    pub unit: &'static str,
    /// What it is, with its range.
    pub what: &'static str,
}

impl Description {
    /// What it is, with shape and unit, on one line.
    #[must_use]
    pub fn sentence(&self) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" ({})", self.unit) };
        let shape = if self.shape.is_empty() { String::new() } else { format!("; {}", self.shape) };
        format!("{}{unit}{shape}", self.what)
    }
}

/// A column of any type, with the values of events that are not written yet.
pub(super) trait Column {
    /// What it is.
    fn description(&self) -> Description;
    /// Its schema.
    fn schema(&self) -> Result<Type>;
    /// The path of its leaves, if they are floating-point numbers.
    fn floating_path(&self) -> Option<ColumnPath>;
    /// Adds the value of one more event.
    fn push(&mut self, row: &Row<'_>);
    /// Number of the collected values, absent ones included.
    fn levels(&self) -> usize;
    /// Writes the collected values and clears them.
    fn flush(&mut self, writer: &mut SerializedColumnWriter<'_>) -> Result<()>;
    /// Compares the collected values with those of a file and clears them: the first event that differs.
    fn compare(&mut self, reader: ColumnReader) -> Result<Option<usize>>;
}

/// A column whose values are `C`.
pub(super) struct TypedColumn<C: Cell> {
    description: Description,
    get: fn(&Row<'_>) -> C,
    leaves: Leaves<C::Leaf>,
    events: usize,
}

impl<C: Cell> TypedColumn<C> {
    pub(super) fn new(description: Description, get: fn(&Row<'_>) -> C) -> Self {
        Self { description, get, leaves: Leaves::default(), events: 0 }
    }

    fn clear(&mut self) {
        self.leaves.clear();
        self.events = 0;
    }
}

impl<C: Cell> Column for TypedColumn<C> {
    fn description(&self) -> Description {
        self.description
    }

    fn schema(&self) -> Result<Type> {
        C::schema(self.description.name)
    }

    fn floating_path(&self) -> Option<ColumnPath> {
        let parts = [vec![self.description.name], C::path()].concat();
        C::FLOATING.then(|| ColumnPath::new(parts.into_iter().map(String::from).collect()))
    }

    fn push(&mut self, row: &Row<'_>) {
        (self.get)(row).shred(0, 0, &mut self.leaves);
        self.events += 1;
    }

    fn levels(&self) -> usize {
        self.leaves.definition.len()
    }

    fn flush(&mut self, writer: &mut SerializedColumnWriter<'_>) -> Result<()> {
        let Leaves { values, definition, repetition } = &self.leaves;
        writer.typed::<C::Leaf>().write_batch(values, Some(definition), Some(repetition))?;
        self.clear();
        Ok(())
    }

    fn compare(&mut self, reader: ColumnReader) -> Result<Option<usize>> {
        let mut reader = get_typed_column_reader::<C::Leaf>(reader);
        let mut found = Leaves::<C::Leaf>::default();
        let Leaves { values, definition, repetition } = &mut found;
        reader.read_records(self.events, Some(definition), Some(repetition), values)?;
        let different = first_difference(&self.leaves, &found);
        self.clear();
        Ok(different)
    }
}

/// The first event in which two columns differ. Levels that cannot vary are not in files, so they come back empty.
fn first_difference<T: DataType>(expected: &Leaves<T>, found: &Leaves<T>) -> Option<usize> {
    let levels_fit = |expected: &[i16], found: &[i16]| found.is_empty() || expected == found;
    let same = expected.values == found.values
        && levels_fit(&expected.definition, &found.definition)
        && levels_fit(&expected.repetition, &found.repetition);
    if same {
        return None;
    }
    let mut event = 0;
    let mut value = 0;
    let present = expected.definition.iter().max().copied().unwrap_or_default();
    for (k, (&definition, &repetition)) in expected.definition.iter().zip(&expected.repetition).enumerate() {
        event += usize::from(k > 0 && repetition == 0);
        let level_differs =
            |expected: i16, found: &[i16]| !found.is_empty() && found.get(k) != Some(&expected);
        if level_differs(definition, &found.definition) || level_differs(repetition, &found.repetition) {
            return Some(event);
        }
        if definition == present {
            if expected.values.get(value) != found.values.get(value) {
                return Some(event);
            }
            value += 1;
        }
    }
    Some(event)
}
