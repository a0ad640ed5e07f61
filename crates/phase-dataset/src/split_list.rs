//! `phase-splits/1`: a split as lists of ids.

use crate::splits::{Item, Split};
use phase_files::{FileError, Problem, WriteError, atomic, json};
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, path::Path};

/// The value of the field `format` of split files.
pub const SPLITS_FORMAT: &str = "phase-splits/1";

/// Name of this kind of file in messages.
const WHAT: &str = "list of splits";

/// The ids of the events that belong to each part of a dataset.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SplitList {
    /// Always [`SPLITS_FORMAT`].
    pub format: String,
    /// Ids of the training events.
    pub train: Vec<String>,
    /// Ids of the validation events.
    pub validation: Vec<String>,
    /// Ids of the test events.
    pub test: Vec<String>,
}

impl SplitList {
    /// The list of a split; one part for each event.
    #[must_use]
    pub fn of(items: &[Item], parts: &[Split]) -> Self {
        let ids = |wanted: Split| {
            let of_part = items.iter().zip(parts).filter(|(_, part)| **part == wanted);
            of_part.map(|(item, _)| item.id.clone()).collect()
        };
        let [train, validation, test] = Split::ALL.map(ids);
        Self { format: SPLITS_FORMAT.into(), train, validation, test }
    }

    /// Reads a list.
    ///
    /// # Errors
    /// If it is not JSON, of another format, or incomplete.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        json::read_format(path, SPLITS_FORMAT, WHAT)
    }

    /// The part of each event.
    ///
    /// # Errors
    /// [`Problem::Shape`] if an event is named twice or not at all, or an id does not belong to any event.
    pub fn parts(&self, items: &[Item]) -> Result<Vec<Split>, Problem> {
        let mut parts: BTreeMap<&str, Split> = BTreeMap::new();
        for (split, ids) in Split::ALL.into_iter().zip([&self.train, &self.validation, &self.test]) {
            for id in ids {
                if parts.insert(id, split).is_some() {
                    return Err(shape(format!("{id:?} is named twice")));
                }
            }
        }
        let found: Result<Vec<Split>, Problem> = items
            .iter()
            .map(|item| {
                parts.remove(item.id.as_str()).ok_or_else(|| shape(format!("{:?} is in no part", item.id)))
            })
            .collect();
        match parts.keys().next() {
            Some(id) if found.is_ok() => Err(shape(format!("{id:?} is no event of the dataset"))),
            _ => found,
        }
    }

    /// Writes the list atomically.
    ///
    /// # Errors
    /// If it cannot be written as JSON, or the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), WriteError> {
        atomic::write_json(path, self)
    }
}

const fn shape(rule: String) -> Problem {
    Problem::Shape { what: WHAT, rule }
}
