//! The attempts at each slot of a dataset, with the reasons for rejection.

use crate::{
    acceptance::Refusal,
    event_set::{SetEntry, member_id, set_video_path},
    manifest::{EventEntry, event_path, video_path},
};
use phase_files::{FileError, Problem, WriteError, atomic, checksum::FileEntry, regular};
use phase_model::json::parse_as;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The records of all slots of a dataset, or of a shard, in order. They are read from disk in every pass over
/// them, so that a dataset may have any number of slots.
pub trait Records {
    /// A pass over the records, all of which are filled.
    fn records(&self) -> Box<dyn Iterator<Item = Result<SlotRecord, FileError>> + '_>;
}

/// The history of one slot of a dataset so far. Attempts are numbered from 0; those before the accepted one
/// were rejected.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SlotRecord {
    /// Digest of the program, its settings and the preset; records with another digest are ignored.
    pub fingerprint: String,
    /// Why each attempt was rejected, in order.
    pub refused: Vec<Refusal>,
    /// The accepted events, once their files exist: one, or those of a set.
    pub entries: Vec<EventEntry>,
    /// The set that they form, if they do.
    pub set: Option<SetEntry>,
}

impl SlotRecord {
    /// The record in a file, or an empty one if there is no valid one; the slot then starts over.
    #[must_use]
    pub fn load(path: &Path, fingerprint: &str) -> Self {
        let text = regular::text(path).unwrap_or_default();
        parse_as(&text)
            .ok()
            .filter(|record: &Self| record.fingerprint == fingerprint)
            .unwrap_or_else(|| Self { fingerprint: fingerprint.into(), ..Self::default() })
    }

    /// The record in a file, which has to be filled.
    ///
    /// # Errors
    /// [`Problem::Shape`] if it is not.
    pub fn load_filled(path: &Path, fingerprint: &str) -> Result<Self, FileError> {
        let record = Self::load(path, fingerprint);
        if record.is_filled() {
            return Ok(record);
        }
        let problem = Problem::Shape { what: "record of a slot", rule: "it holds no event".into() };
        Err(FileError { file: path.to_owned(), problem })
    }

    /// Writes the record atomically.
    ///
    /// # Errors
    /// If the record cannot be written as JSON, or the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), WriteError> {
        atomic::write_json_line(path, self)
    }

    /// Whether the slot has its events.
    #[must_use]
    pub const fn is_filled(&self) -> bool {
        !self.entries.is_empty()
    }

    /// Whether its events, its set and their files have the names that belong to the slot with this name.
    #[must_use]
    pub(crate) fn is_named(&self, slot: &str) -> bool {
        let event = |(k, entry): (usize, &EventEntry)| {
            let in_set = self.set.is_some();
            let id = if in_set { member_id(slot, k) } else { slot.into() };
            let video = entry.video.as_ref().is_none_or(|video| *video.path.as_str() == *video_path(&id));
            let set = entry.set.as_ref().map(|place| place.set.as_str());
            entry.id == id
                && *entry.event.path.as_str() == *event_path(&id)
                && video
                && set == in_set.then_some(slot)
        };
        let video = |video: &FileEntry| *video.path.as_str() == *set_video_path(slot);
        self.set.as_ref().is_none_or(|set| set.id == slot && set.video.as_ref().is_none_or(video))
            && (self.set.is_some() || self.entries.len() == 1)
            && self.entries.iter().enumerate().all(event)
    }

    /// The files of its events and of its set.
    pub fn files(&self) -> impl Iterator<Item = &FileEntry> {
        let of_set = self.set.iter().filter_map(|set| set.video.as_ref());
        self.entries.iter().flat_map(EventEntry::files).chain(of_set)
    }
}
