//! `shard.json`: one part of a dataset that is generated in several places.

use crate::{
    ExportError,
    form::StimulusForm,
    preset::slot_id,
    slot_record::{Records, SlotRecord},
};
use core::{iter::StepBy, ops::Range};
use phase_files::{
    FileError, Problem, WriteError, atomic, checksum::FileEntry, json, measured::MeasuredFile, regular,
};
use phase_model::{json::parse_as, setting::EVENTS};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::{
    fs::File,
    io::{BufRead, BufReader, Read, Seek, SeekFrom, Write},
    path::{Path, PathBuf},
};

/// The value of the field `format` of shards.
pub const SHARD_FORMAT: &str = "phase-shard/3";
/// Longest record of a slot (bytes), which has a line for each scene that was refused.
const LONGEST_RECORD: u64 = 1 << 28;
/// The shard's file name. It is written last: a folder with it is complete.
pub const SHARD_FILE: &str = "shard.json";
/// File name of the records of a shard's slots: one a line, as JSON.
pub const SLOTS_FILE: &str = "slots.jsonl";

/// Description of a dataset apart from its events. All of its shards have the same one.
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
    /// Length and look of the events, where they are not the usual ones.
    #[serde(default, skip_serializing_if = "StimulusForm::is_default")]
    pub form: StimulusForm,
    /// Whether events were selected.
    pub selected: bool,
    /// Whether events have videos.
    pub videos: bool,
    /// The date of publication, if it was given: YYYY-MM-DD.
    pub date_published: Option<String>,
    /// The command that generates the whole dataset.
    pub command: String,
}

/// One shard: the slots k − 1, k − 1 + n, k − 1 + 2 n … of the dataset.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shard {
    /// Always [`SHARD_FORMAT`].
    pub format: String,
    /// Number of the shard, from 1.
    pub shard: usize,
    /// Of how many.
    pub of: usize,
    /// The dataset it is a part of.
    pub whole: DatasetDescription,
    /// Digest of the program, its settings and the preset, as in every record.
    pub fingerprint: String,
    /// The records of its slots, in order: [`SLOTS_FILE`].
    pub slots: FileEntry,
}

impl Shard {
    /// Describes a shard whose records have been written, by [`write_slots`].
    #[must_use]
    pub fn of_records(
        (shard, of): (usize, usize),
        whole: DatasetDescription,
        fingerprint: String,
        slots: FileEntry,
    ) -> Self {
        Self { format: SHARD_FORMAT.into(), shard, of, whole, fingerprint, slots }
    }

    /// Reads what a folder's shard is, and checks that its records are as they were written.
    ///
    /// # Errors
    /// If it is not JSON, of another format, or incomplete.
    pub fn read(folder: &Path) -> Result<Self, FileError> {
        let path = folder.join(SHARD_FILE);
        let fail = |problem| FileError { file: path.clone(), problem };
        let what = "shard of a dataset";
        let shard: Self = json::read_format(&path, SHARD_FORMAT, what)?;
        if shard.shard == 0 || shard.shard > shard.of {
            let rule = format!("there is no shard {} of {}", shard.shard, shard.of);
            return Err(fail(Problem::Shape { what, rule }));
        }
        for count in [shard.whole.slots, shard.whole.events] {
            if let Err(error) = EVENTS.check_count(count) {
                return Err(fail(Problem::Shape { what, rule: error.to_string() }));
            }
        }
        shard.slots.verify(folder)?;
        Ok(shard)
    }

    /// Writes it atomically.
    ///
    /// # Errors
    /// If it cannot be written as JSON, or the file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), WriteError> {
        atomic::write_json(&folder.join(SHARD_FILE), self)
    }

    /// Number of its slots.
    #[must_use]
    pub fn len(&self) -> usize {
        slots(self.shard, self.of, self.whole.slots).count()
    }

    /// Whether it has no slot, as happens if there are more shards than slots.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The records of its slots in a folder, in order.
    #[must_use]
    pub fn records(&self, folder: &Path) -> SlotReader {
        let file = folder.join(SLOTS_FILE);
        let fingerprint = self.fingerprint.clone();
        let slots = slots(self.shard, self.of, self.whole.slots);
        SlotReader { file, fingerprint, preset: self.whole.preset.clone(), offset: 0, slots }
    }
}

/// Writes the records of a shard, one a line, atomically, and describes the file.
///
/// # Errors
/// [`ExportError`].
pub fn write_slots(folder: &Path, records: &dyn Records) -> Result<FileEntry, ExportError> {
    let path = folder.join(SLOTS_FILE);
    let mut file = MeasuredFile::create(folder, SLOTS_FILE)?;
    for record in records.records() {
        let line = serde_json::to_string(&record?).map_err(|error| WriteError::json(&path, error))?;
        writeln!(file, "{line}").map_err(|source| file.failed(source))?;
    }
    Ok(file.commit()?)
}

/// Reads the records of a shard one after the other. The file is opened for each of them, because a dataset
/// may have more shards than a process may have open files.
#[derive(Debug)]
pub struct SlotReader {
    file: PathBuf,
    fingerprint: String,
    /// Name of the preset, with which ids begin.
    preset: String,
    offset: u64,
    /// The slots to come.
    slots: StepBy<Range<usize>>,
}

impl SlotReader {
    fn read(&mut self, slot: usize) -> Result<SlotRecord, FileError> {
        let fail = |problem| FileError { file: self.file.clone(), problem };
        let what = "list of slots";
        let mut line = String::new();
        let read = |mut file: File, line: &mut String| {
            file.seek(SeekFrom::Start(self.offset))?;
            BufReader::new(file.take(LONGEST_RECORD)).read_line(line)
        };
        let bytes =
            read(regular::open(&self.file)?, &mut line).map_err(|error| fail(Problem::Unreadable(error)))?;
        if bytes == 0 {
            let rule = format!("the records of {} slots are missing", self.slots.len() + 1);
            return Err(fail(Problem::Shape { what, rule }));
        }
        self.offset += bytes as u64;
        let record: SlotRecord =
            parse_as(&line).map_err(|source| fail(Problem::Incomplete { what, source }))?;
        let id = slot_id(&self.preset, slot);
        let rule = if !record.is_filled() {
            format!("the slot {id} holds no event")
        } else if record.fingerprint != self.fingerprint {
            format!("the slot {id} is of another program or of other settings")
        } else if !record.is_named(&id) {
            format!("the slot {id} has an event, a set or a file of another name")
        } else {
            return Ok(record);
        };
        Err(fail(Problem::Shape { what, rule }))
    }
}

impl Iterator for SlotReader {
    type Item = Result<SlotRecord, FileError>;

    /// The next record; none after an error.
    fn next(&mut self) -> Option<Self::Item> {
        let slot = self.slots.next()?;
        let record = self.read(slot);
        if record.is_err() {
            self.slots = slots(1, 1, 0);
        }
        Some(record)
    }
}

/// The slots of shard `shard` (from 1) of `of`, out of `count`.
pub fn slots(shard: usize, of: usize, count: usize) -> StepBy<Range<usize>> {
    (shard.saturating_sub(1)..count).step_by(of.max(1))
}
