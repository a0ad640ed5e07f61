//! What was tried for each event of a dataset, and why it was refused.

use crate::{WriteError, atomic, manifest::EventEntry};
use phase_evidence::selection::Refusal;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Everything that became of one slot of a dataset so far. Attempts are numbered from 0; those before the accepted
/// one were refused.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// Stands for the program, its settings and the preset; a record of others counts for nothing.
    pub fingerprint: String,
    /// Why each attempt was refused, in order.
    pub refused: Vec<Refusal>,
    /// The accepted event, once its files are there.
    pub entry: Option<EventEntry>,
}

impl Record {
    /// The record in a file, or an empty one if there is none that can be trusted: then the slot begins anew.
    #[must_use]
    pub fn load(path: &Path, fingerprint: &str) -> Self {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        serde_json::from_str(&text)
            .ok()
            .filter(|record: &Self| record.fingerprint == fingerprint)
            .unwrap_or_else(|| Self { fingerprint: fingerprint.into(), ..Self::default() })
    }

    /// Writes the record whole or not at all.
    ///
    /// # Errors
    /// If the record cannot be written as JSON, or the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), WriteError> {
        atomic::write_json_line(path, self)
    }
}
