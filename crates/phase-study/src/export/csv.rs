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

    /// Adds a column of numbers that have a unit.
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The cells of a row, read by the rules of RFC 4180.
    fn read(line: &str) -> Vec<String> {
        let (mut cells, mut cell, mut inside) = (Vec::new(), String::new(), false);
        let mut letters = line.chars().peekable();
        while let Some(letter) = letters.next() {
            match letter {
                '"' if inside && letters.peek() == Some(&'"') => cell.extend(letters.next()),
                '"' => inside = !inside,
                ',' | '\n' if !inside => cells.push(std::mem::take(&mut cell)),
                letter => cell.push(letter),
            }
        }
        cells
    }

    proptest! {
        #[test]
        fn texts_are_read_back_and_none_is_a_formula(texts in prop::collection::vec(any::<String>(), 2..5)) {
            let mut table = Table::default();
            (0..texts.len()).for_each(|k| table.column(format!("c{k}"), ""));
            table.row(texts.iter().cloned().map(Cell::Text).collect());
            let csv = table.to_csv();
            let cells = read(csv.split_once('\n').unwrap().1);
            for (text, cell) in texts.iter().zip(&cells) {
                let marked = format!("'{text}");
                prop_assert!(cell == text || *cell == marked);
                prop_assert!(!cell.trim_start().starts_with(['=', '+', '-', '@']));
            }
            prop_assert_eq!(cells.len(), texts.len());
        }
    }
}
