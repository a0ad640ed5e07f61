//! Answers to a sealed dataset, scored by whoever keeps it.

use crate::{
    error::RunError,
    listener::Listener,
    seal::{SEAL_FILE, unseal},
};
use phase_files::{checksum::sha256_hex, json};
use phase_report::evaluation::SealedSet;
use serde_json::Value;
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

/// The beginning of the labels of sealed sets, before the first digits of the seal's digest.
pub(super) const SEALED: &str = "sealed-";
/// Digits of the digest in a label: 48 bits.
const LABEL_DIGITS: usize = 12;

/// The seal that predictions are about.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Sealed {
    /// The folder that was published.
    pub published: PathBuf,
    /// The folder of the questions, if they were sealed, too.
    pub questions: Option<PathBuf>,
}

/// A seal that was opened.
pub(super) struct Opened {
    /// The label of the set.
    pub(super) label: String,
    /// The seal, for the scores.
    pub(super) set: SealedSet,
    /// The published names of the events, by those of the dataset.
    pub(super) names: BTreeMap<String, String>,
}

impl Sealed {
    /// Proves that a dataset is the one that was sealed, and that predictions name its events as the
    /// published folder does.
    pub(super) fn open(
        &self,
        dataset: &Path,
        predictions: &Path,
        listener: &dyn Listener,
    ) -> Result<Opened, RunError> {
        let found = unseal(&self.published, dataset, self.questions.as_deref(), listener)?;
        let answered: Value = json::read(predictions)?;
        let ids = answered["events"].as_array().into_iter().flatten().filter_map(|it| it["id"].as_str());
        if let Some(unknown) = ids.into_iter().find(|id| !found.contains_key(*id)) {
            return Err(RunError::Usage(format!(
                "{}: event {unknown:?} is none of those in {}",
                predictions.display(),
                self.published.display()
            )));
        }
        let seal = sha256_hex(&json::bytes(&self.published.join(SEAL_FILE))?);
        let label = format!("{SEALED}{}", seal.get(..LABEL_DIGITS).unwrap_or_default());
        let set = SealedSet { seal, events: found.len() };
        Ok(Opened { label, set, names: found.into_iter().map(|(name, id)| (id, name)).collect() })
    }
}
