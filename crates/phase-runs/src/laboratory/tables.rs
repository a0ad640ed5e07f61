//! Tables as laboratories keep them: TSV with a JSON sidecar (BIDS), and CSV.

use crate::error::RunError;
use phase_files::{WriteError, atomic, regular};
use phase_model::foreign;
use serde_json::{Map, Value, json};
use std::path::Path;

/// Stands in BIDS for what there is not.
pub(super) const MISSING: &str = "n/a";

/// A column: its name, unit (may be empty) and meaning.
pub(super) type Column = (String, String, String);

/// A table of texts.
#[derive(Debug, Default)]
pub(super) struct Table {
    pub(super) columns: Vec<Column>,
    pub(super) rows: Vec<Vec<String>>,
}

impl Table {
    pub(super) fn column(&mut self, name: impl Into<String>, unit: &str, meaning: impl Into<String>) {
        self.columns.push((name.into(), unit.into(), meaning.into()));
    }

    /// The table with a separator between its cells, lines ended by LF.
    pub(super) fn text(&self, separator: u8) -> Result<Vec<u8>, csv::Error> {
        let mut writer = csv::WriterBuilder::new().delimiter(separator).from_writer(Vec::new());
        writer.write_record(self.columns.iter().map(|(name, ..)| name))?;
        for row in &self.rows {
            writer.write_record(row)?;
        }
        writer.into_inner().map_err(|error| error.into_error().into())
    }

    /// Writes `FILE.tsv` and beside it `FILE.json`, which describes the columns.
    pub(super) fn write_tsv(&self, path: &Path) -> Result<(), RunError> {
        self.write(path, b'\t')?;
        let of = |(name, unit, meaning): &Column| {
            let mut about = json!({ "Description": meaning });
            if !unit.is_empty() {
                about["Units"] = unit.as_str().into();
            }
            (name.clone(), about)
        };
        let sidecar: Map<String, Value> = self.columns.iter().map(of).collect();
        Ok(atomic::write_json(&path.with_extension("json"), &sidecar)?)
    }

    pub(super) fn write_csv(&self, path: &Path) -> Result<(), RunError> {
        self.write(path, b',')
    }

    fn write(&self, path: &Path, separator: u8) -> Result<(), RunError> {
        let text = self.text(separator).map_err(|error| WriteError {
            path: path.to_owned(),
            action: "write the table",
            source: error.into(),
        })?;
        Ok(atomic::write(path, &text)?)
    }
}

/// A table that was read: names of columns, and rows of as many cells.
#[derive(Debug)]
pub(super) struct Sheet {
    pub(super) names: Vec<String>,
    pub(super) rows: Vec<Vec<String>>,
}

impl Sheet {
    /// Reads a `.tsv`, or else comma-separated, table with a first line of names; a byte-order mark is
    /// skipped.
    pub(super) fn read(path: &Path) -> Result<Self, RunError> {
        let text = regular::text(path)?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
        let separator = if path.extension().is_some_and(|it| it == "tsv") { b'\t' } else { b',' };
        let mut reader = csv::ReaderBuilder::new().delimiter(separator).from_reader(text.as_bytes());
        let names: Vec<String> = match reader.headers() {
            Ok(names) => names.iter().map(str::to_owned).collect(),
            Err(error) => return Err(unusable(path, &foreign::table(&error.to_string()))),
        };
        if let Some(twice) = (1..names.len()).find(|&k| names[..k].contains(&names[k])) {
            return Err(unusable(path, &format!("has two columns {}", names[twice])));
        }
        let rows = reader.records().map(|row| row.map(|row| row.iter().map(str::to_owned).collect()));
        let rows = rows.collect::<Result<Vec<Vec<String>>, _>>();
        let rows = rows.map_err(|error| unusable(path, &foreign::table(&error.to_string())))?;
        Ok(Self { names, rows })
    }

    pub(super) fn column(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }
}

/// An input file that breaks a rule.
pub(crate) fn unusable(path: &Path, rule: &str) -> RunError {
    RunError::Usage(format!("{}: {rule}", path.display()))
}

/// An input file of no known form.
pub(super) fn unknown_form(path: &Path, wanted: &str) -> RunError {
    unusable(path, &format!("is none of the files that are read here: {wanted}"))
}
