//! Writing a manifest while its events are read, so that they are never all in memory.

use crate::{
    ExportError,
    acceptance::Acceptance,
    form::StimulusForm,
    manifest::{DATASET_FORMAT, MANIFEST_FILE, write_digest},
    overview::Overview,
    slot_record::{Records, SlotRecord},
};
use core::cell::RefCell;
use phase_files::{FileError, checksum::FileEntry, measured::MeasuredFile};
use serde::{Serialize, Serializer};
use serde_json::Value;
use std::{
    io::{self, Write},
    path::Path,
};

/// The members of [`Manifest`](crate::manifest::Manifest), in its order; the same bytes result.
#[derive(Serialize)]
struct ManifestText<'a, E, S> {
    format: &'static str,
    generator: &'a str,
    preset: &'a str,
    seed: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    date_published: Option<&'a str>,
    settings: &'a Value,
    #[serde(skip_serializing_if = "StimulusForm::is_default")]
    form: &'a StimulusForm,
    #[serde(skip_serializing_if = "<[Acceptance]>::is_empty")]
    selection: &'a [Acceptance],
    events: E,
    #[serde(skip_serializing_if = "Option::is_none")]
    sets: Option<S>,
    files: &'a [FileEntry],
}

/// A list that is read from the records as it is written. The first error ends it, and is kept.
struct Members<'a, F> {
    records: &'a dyn Records,
    of: F,
    failure: &'a RefCell<Option<FileError>>,
}

impl<T: Serialize, I: IntoIterator<Item = T>, F: Fn(SlotRecord) -> I> Serialize for Members<'_, F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let whole = |record: Result<SlotRecord, FileError>| match record {
            Ok(record) => Some(record),
            Err(error) => {
                *self.failure.borrow_mut() = Some(error);
                None
            }
        };
        serializer.collect_seq(self.records.records().map_while(whole).flat_map(&self.of))
    }
}

/// Writes the manifest of a dataset into a folder, its digest first, each atomically, and returns the digest.
/// The events are those of the records, of which one at a time is in memory.
///
/// # Errors
/// [`ExportError`].
pub fn write_manifest(
    folder: &Path,
    overview: &Overview,
    records: &dyn Records,
) -> Result<String, ExportError> {
    let failure = RefCell::new(None);
    let text = ManifestText {
        format: DATASET_FORMAT,
        generator: &overview.generator,
        preset: &overview.preset,
        seed: overview.seed,
        date_published: overview.date_published.as_deref(),
        settings: &overview.settings,
        form: &overview.form,
        selection: &overview.selection,
        events: Members { records, of: |record: SlotRecord| record.entries, failure: &failure },
        sets: (overview.sets > 0).then_some(Members {
            records,
            of: |record: SlotRecord| record.set,
            failure: &failure,
        }),
        files: &overview.files,
    };
    let mut file = MeasuredFile::create(folder, MANIFEST_FILE)?;
    let written = serde_json::to_writer_pretty(&mut file, &text).map_err(io::Error::from);
    let written = written.and_then(|()| file.write_all(b"\n"));
    if let Some(error) = failure.take() {
        return Err(error.into());
    }
    written.map_err(|source| file.failed(source))?;
    let digest = file.entry().sha256;
    write_digest(folder, &digest)?;
    file.commit()?;
    Ok(digest)
}
