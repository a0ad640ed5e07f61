//! `shard.json`: one part of a dataset that is generated in several places.

use crate::{FileError, Problem, WriteError, atomic, json, slot_record::SlotRecord};
use phase_model::json::check_format;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::Path;

/// The value of the field `format` of shards.
pub const SHARD_FORMAT: &str = "phase-shard/2";
/// The shard's file name. It is written last: a folder with it is complete.
pub const SHARD_FILE: &str = "shard.json";

/// What a dataset is, apart from its events: the same for all of its shards.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DatasetDescription {
    /// Name of the preset.
    pub preset: String,
    /// Number of events.
    pub events: usize,
    /// Number of slots: that of events, or of sets.
    pub slots: usize,
    /// The random seed of the dataset.
    pub seed: u64,
    /// Name and version of the program.
    pub generator: String,
    /// Settings of simulation and agents.
    pub settings: Value,
    /// Whether events were selected.
    pub selected: bool,
    /// Whether events have videos; not written if true, which is the default.
    #[serde(default = "with_videos", skip_serializing_if = "Clone::clone")]
    pub videos: bool,
    /// The date of publication, if it was given: YYYY-MM-DD.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub date_published: Option<String>,
    /// The command that generates the whole dataset.
    pub command: String,
}

const fn with_videos() -> bool {
    true
}

/// One shard: the slots k − 1, k − 1 + n, k − 1 + 2 n … of the dataset.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shard {
    /// Always [`SHARD_FORMAT`].
    pub format: String,
    /// Which one, from 1.
    pub shard: usize,
    /// Of how many.
    pub of: usize,
    /// The dataset it is a part of.
    pub whole: DatasetDescription,
    /// The records of its slots, in order.
    pub slots: Vec<SlotRecord>,
}

impl Shard {
    /// Reads a shard and checks that it has an event for each of its slots.
    ///
    /// # Errors
    /// If it is not JSON, of another format, or incomplete.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let fail = |problem| FileError { file: path.to_owned(), problem };
        let what = "shard of a dataset";
        let shape = |rule: String| Problem::Shape { what, rule };
        let value = json::read(path)?;
        check_format(&value, SHARD_FORMAT).map_err(|error| fail(error.into()))?;
        let shard: Self =
            serde_json::from_value(value).map_err(|source| fail(Problem::Incomplete { what, source }))?;
        if shard.shard == 0 || shard.shard > shard.of {
            return Err(fail(shape(format!("there is no shard {} of {}", shard.shard, shard.of))));
        }
        let expected = slots(shard.shard, shard.of, shard.whole.slots).count();
        if shard.slots.len() != expected || !shard.slots.iter().all(SlotRecord::is_filled) {
            let found = shard.slots.iter().filter(|slot| slot.is_filled()).count();
            return Err(fail(shape(format!("it holds {found} filled slots instead of {expected}"))));
        }
        Ok(shard)
    }

    /// Writes the shard atomically.
    ///
    /// # Errors
    /// If it cannot be written as JSON, or the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), WriteError> {
        atomic::write_json_line(path, self)
    }
}

/// The slots of shard `shard` (from 1) of `of`, out of `count`.
pub fn slots(shard: usize, of: usize, count: usize) -> impl Iterator<Item = usize> {
    (shard.saturating_sub(1)..count).step_by(of.max(1))
}
