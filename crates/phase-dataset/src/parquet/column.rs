//! A column: its description for people, its schema, and the values of the current row group.

use super::{
    cell::{Cell, Leaves},
    row::Row,
};
use parquet::{
    errors::Result,
    file::writer::SerializedColumnWriter,
    schema::types::{ColumnPath, Type},
};
use std::sync::Arc;

/// Documentation of a column, for people.
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
    /// Meaning of the values, with their range.
    pub what: &'static str,
}

impl Description {
    /// Meaning, shape and unit on one line.
    #[must_use]
    pub fn sentence(&self) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" ({})", self.unit) };
        let shape = if self.shape.is_empty() { String::new() } else { format!("; {}", self.shape) };
        format!("{}{unit}{shape}", self.what)
    }
}

/// A column of any type, with the values of events that are not written yet.
pub(super) trait Column {
    /// Documentation of the column.
    fn description(&self) -> Description;
    /// Its schema.
    fn schema(&self) -> Result<Type>;
    /// The path of its leaves, if they are floating-point numbers.
    fn floating_path(&self) -> Option<ColumnPath>;
    /// Adds the value of one more event.
    fn push(&mut self, row: &Row<'_>);
    /// Writes the collected values and clears them.
    fn flush(&mut self, writer: &mut SerializedColumnWriter<'_>) -> Result<()>;
}

/// The schema of a file with these columns.
pub(super) fn schema(columns: &[Box<dyn Column>]) -> Result<Arc<Type>> {
    let fields = columns.iter().map(|column| Ok(Arc::new(column.schema()?))).collect::<Result<Vec<_>>>()?;
    Ok(Arc::new(Type::group_type_builder("schema").with_fields(fields).build()?))
}

/// A column whose values are `C`.
pub(super) struct TypedColumn<C: Cell> {
    description: Description,
    get: fn(&Row<'_>) -> C,
    leaves: Leaves<C::Leaf>,
}

impl<C: Cell> TypedColumn<C> {
    pub(super) fn new(description: Description, get: fn(&Row<'_>) -> C) -> Self {
        Self { description, get, leaves: Leaves::default() }
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
    }

    fn flush(&mut self, writer: &mut SerializedColumnWriter<'_>) -> Result<()> {
        let Leaves { values, definition, repetition } = &self.leaves;
        writer.typed::<C::Leaf>().write_batch(values, Some(definition), Some(repetition))?;
        self.leaves.clear();
        Ok(())
    }
}
