//! What was tried for each event of a dataset, and why it was refused.

use crate::{WriteError, atomic, manifest::EventEntry};
use phase_evidence::selection::Refusal;
use phase_sampler::Variant;
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, path::Path};

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
    /// If the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), WriteError> {
        // Plain data of ours always has a JSON form.
        atomic::write(path, serde_json::to_string(self).unwrap_or_default().as_bytes())
    }
}

/// How often scenes of one variant came to show their label.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Acceptance {
    /// The variant.
    pub variant: Variant,
    /// Events accepted.
    pub events: usize,
    /// Scenes simulated for them.
    pub attempts: usize,
    /// How many were refused for each reason.
    pub refused: BTreeMap<Refusal, usize>,
}

/// Counts attempts by variant, one slot after the other.
#[derive(Clone, Debug, Default)]
pub struct Tally(BTreeMap<Variant, Acceptance>);

impl Tally {
    /// Adds what was tried for one accepted event.
    pub fn add(&mut self, variant: Variant, refused: &[Refusal]) {
        let empty = Acceptance { variant, events: 0, attempts: 0, refused: BTreeMap::new() };
        let row = self.0.entry(variant).or_insert(empty);
        row.events += 1;
        row.attempts += 1 + refused.len();
        for &reason in refused {
            *row.refused.entry(reason).or_default() += 1;
        }
    }

    /// The counts, in the order of [`Variant::ALL`].
    #[must_use]
    pub fn rows(self) -> Vec<Acceptance> {
        self.0.into_values().collect()
    }
}

/// The counts as a table in Markdown.
#[must_use]
pub fn table(rows: &[Acceptance]) -> String {
    let mut text = String::from(
        "| kind | variant | events | scenes tried | accepted | refused for |\n|---|---|---|---|---|---|\n",
    );
    for row in rows {
        let mut reasons: Vec<(usize, &str)> =
            row.refused.iter().map(|(reason, &count)| (count, reason.name())).collect();
        reasons.sort_by_key(|&(count, name)| (core::cmp::Reverse(count), name));
        let reasons: Vec<String> = reasons.iter().map(|(count, name)| format!("{name} {count}")).collect();
        text += &format!(
            "| {} | {} | {} | {} | {:.0} % | {} |\n",
            row.variant.kind().name(),
            row.variant.name(),
            row.events,
            row.attempts,
            100.0 * row.events as f64 / row.attempts.max(1) as f64,
            if reasons.is_empty() { "–".into() } else { reasons.join(", ") }
        );
    }
    text
}
