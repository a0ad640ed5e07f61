//! People's ratings of the evaluated events, from a file.

use super::input::Input;
use crate::{error::RunError, listener::Listener};
use phase_eval::ratings::{RatingCounts, ratings};
use phase_files::{
    FileError, Problem,
    checksum::{hexadecimal, sha256},
    json,
};
use std::{collections::BTreeMap, path::Path};

/// Ratings of events by people.
#[derive(Clone, Debug)]
pub(crate) struct Ratings {
    counts: BTreeMap<String, RatingCounts>,
    /// Digest of the file.
    pub(super) sha256: String,
}

impl Ratings {
    /// Reads a file, which has to be about some of the events.
    pub(crate) fn read(file: &Path, inputs: &[&Input], listener: &dyn Listener) -> Result<Self, RunError> {
        let bytes = json::bytes(file)?;
        let fail = |problem: Problem| FileError { file: file.to_owned(), problem };
        let value = phase_model::json::parse(&bytes).map_err(|error| fail(error.into()))?;
        let counts = ratings(&value).map_err(|error| fail(Problem::content(error)))?;
        let ids = || inputs.iter().flat_map(|input| input.events.iter().map(|event| event.id.as_str()));
        let rated = ids().filter(|id| counts.contains_key(*id)).count();
        if rated == 0 {
            let first = ids().next().unwrap_or_default();
            return Err(RunError::unknown_id(file, first, counts.keys().map(String::as_str)));
        }
        let others = counts.keys().filter(|id| !ids().any(|other| other == *id)).count();
        if others > 0 {
            listener.note(&format!("note: {}: {others} of its events are not evaluated", file.display()));
        }
        Ok(Self { counts, sha256: hexadecimal(&sha256(&bytes)) })
    }

    /// Ratings of an event, if it was rated.
    pub(super) fn of(&self, id: &str) -> Option<RatingCounts> {
        self.counts.get(id).copied()
    }
}
