//! The shards of a dataset become one.

use super::{Generated, Outcome, complete::complete, run_of};
use crate::{
    error::RunError,
    interrupt,
    listener::Listener,
    resume::{check_complete, is_finished},
    words,
};
use phase_dataset::{
    manifest::MANIFEST_FILE,
    parquet,
    shard::{SHARD_FILE, Shard, SlotReader},
    slot_record::{Records, SlotRecord},
};
use phase_files::{FileError, atomic, checksum::FileEntry, folder::Folder, regular};
use std::path::{Path, PathBuf};

/// Combines all shards of a dataset, in any order, in a folder: new, empty, or of the same merge. The shards
/// are unchanged; the result is the same, byte for byte, as that of a single run.
///
/// # Errors
/// If a shard is missing or damaged, the folder cannot be used, a file cannot be written, or a stop was
/// requested.
pub fn merge(shards: &[PathBuf], out: &Path, listener: &dyn Listener) -> Result<Generated, RunError> {
    let shards = Shards::read(shards)?;
    let whole = &shards.first().whole;
    let finished = run_of(whole, None);
    let run = finished.clone().with("command", "merge");
    if is_finished(out, MANIFEST_FILE, &run, listener)? {
        return super::finished(out, whole.slots, &finished);
    }
    let folder = Folder::claim(out, &run)?;
    folder.subfolder("events")?;
    if whole.videos {
        folder.subfolder("videos")?;
    }
    folder.subfolder(parquet::FOLDER)?;
    let progress = listener.progress_over(
        &format!("copying {} of {} shards", words::events(whole.events), shards.0.len()),
        whole.slots,
    );
    for (shard, from) in &shards.0 {
        for record in shard.records(from) {
            if interrupt::requested() {
                return Err(RunError::Interrupted(out.to_owned()));
            }
            record?.files().try_for_each(|file| copy(file, from, out))?;
            progress.steps(1);
        }
    }
    drop(progress);
    let completed = complete(out, whole, &shards, listener)?;
    folder.finish()?;
    Ok(Generated {
        folder: out.to_owned(),
        events: whole.events,
        outcome: Outcome::Made(Box::new(completed)),
    })
}

/// All shards of one dataset, in order, with their folders; never empty.
struct Shards(Vec<(Shard, PathBuf)>);

impl Shards {
    /// Reads shards in any order and checks that they are complete and belong together.
    fn read(folders: &[PathBuf]) -> Result<Self, RunError> {
        let mut shards = Vec::new();
        for folder in folders {
            let file = folder.join(SHARD_FILE);
            if folder.is_dir() && !file.exists() {
                let sentence = format!("{}: holds no finished shard (no {SHARD_FILE})", folder.display());
                return Err(RunError::Usage(sentence));
            }
            shards.push((Shard::read(folder)?, folder.clone()));
        }
        shards.sort_by_key(|(shard, _)| shard.shard);
        let Some((first, place)) = shards.first() else {
            return Err(RunError::Usage("merge needs the folders of all shards".into()));
        };
        for (shard, folder) in &shards {
            let same_program = shard.fingerprint == first.fingerprint;
            if shard.of != first.of || shard.whole != first.whole || !same_program {
                return Err(RunError::Usage(format!(
                    "{}: is no shard of the same run of the same program as {}",
                    folder.display(),
                    place.display()
                )));
            }
        }
        check_complete(first.of, shards.iter().map(|(shard, folder)| (shard.shard, folder.as_path())))?;
        Ok(Self(shards))
    }

    fn first(&self) -> &Shard {
        &self.0[0].0
    }
}

impl Records for Shards {
    fn records(&self) -> Box<dyn Iterator<Item = Result<SlotRecord, FileError>> + '_> {
        let mut readers: Vec<SlotReader> =
            self.0.iter().map(|(shard, folder)| shard.records(folder)).collect();
        let of = readers.len();
        Box::new((0..self.first().whole.slots).filter_map(move |slot| readers[slot % of].next()))
    }
}

/// Copies a file that agrees with its shard, unless it already exists.
fn copy(file: &FileEntry, from: &Path, to: &Path) -> Result<(), RunError> {
    if file.verify(to).is_ok() {
        return Ok(());
    }
    file.verify(from)?;
    let bytes = regular::bytes(&file.place(from))?;
    Ok(atomic::write(&file.place(to), &bytes)?)
}
