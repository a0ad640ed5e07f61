//! Tables as text (RFC 4180).

/// A column of a table.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Column {
    pub(super) name: String,
    pub(super) description: String,
    pub(super) unit: Option<&'static str>,
}

/// A cell. Missing ones are empty.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Cell {
    Missing,
    Number(i64),
    Truth(bool),
    Text(String),
}

/// A table.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(super) struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// Adds a column, before there are rows.
    pub(super) fn column(&mut self, name: impl Into<String>, description: impl Into<String>) {
        self.columns.push(Column { name: name.into(), description: description.into(), unit: None });
    }

    /// The same with a unit.
    pub(super) fn measure(&mut self, name: &str, unit: &'static str, description: &str) {
        self.columns.push(Column { name: name.into(), description: description.into(), unit: Some(unit) });
    }

    /// Adds a row; cells beyond the columns are dropped, cells that lack are missing.
    pub(super) fn row(&mut self, mut cells: Vec<Cell>) {
        cells.resize(self.columns.len(), Cell::Missing);
        self.rows.push(cells);
    }

    pub(super) fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The table as text, a line for the names of the columns and one for each row.
    pub(super) fn to_csv(&self) -> String {
        let names: Vec<String> = self.columns.iter().map(|column| quoted(&column.name)).collect();
        let mut text = names.join(",") + "\n";
        for row in &self.rows {
            let cells: Vec<String> = row.iter().map(cell).collect();
            text += &cells.join(",");
            text.push('\n');
        }
        text
    }
}

fn cell(cell: &Cell) -> String {
    match cell {
        Cell::Missing => String::new(),
        Cell::Number(number) => number.to_string(),
        Cell::Truth(truth) => truth.to_string(),
        Cell::Text(text) => quoted(&harmless(text)),
    }
}

/// Text that no spreadsheet takes for a formula: an apostrophe goes before what begins like one.
fn harmless(text: &str) -> String {
    let formula = text.trim_start().starts_with(['=', '+', '-', '@', '＝', '＋', '－', '＠', '|', '%']);
    if formula || text.starts_with(['\t', '\r', '\n']) { format!("'{text}") } else { text.into() }
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r', '\'', ';']) || text.trim() != text {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.into()
    }
}
