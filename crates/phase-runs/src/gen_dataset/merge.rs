//! `merge`: combines the shards of a dataset.

use super::{announce, complete::complete, options::Merge, run_of};
use crate::{console, context::Context, error::CliError, interrupt};
use phase_dataset::{
    manifest::MANIFEST_FILE,
    parquet,
    shard::{SHARD_FILE, Shard, SlotReader},
    slot_record::{Records, SlotRecord},
};
use phase_files::{
    FileError, WriteError, atomic,
    checksum::FileEntry,
    folder::{self, Contents, Folder},
};
use std::{
    fs,
    path::{Path, PathBuf},
};

/// Runs the command. The shards are unchanged; the result is the same, byte for byte, as that of a single
/// run.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &Merge, context: &Context) -> Result<(), CliError> {
    let (shards, out) = (Shards::read(&arguments.shards)?, &arguments.out);
    let whole = &shards.first().whole;
    let finished = run_of(whole, None);
    let run = finished.clone().with("command", "merge");
    match folder::inspect(out, MANIFEST_FILE)? {
        Contents::Finished => return super::check_finished(out, whole.slots, &finished, arguments.output),
        Contents::Unfinished(other) => {
            run.check(out, "an unfinished", &other)?;
            context.note(format!("continuing in {}", out.display()));
        }
        Contents::Nothing => {}
    }
    interrupt::listen();
    let folder = Folder::claim(out, &run)?;
    folder.subfolder("events")?;
    if whole.videos {
        folder.subfolder("videos")?;
    }
    folder.subfolder(parquet::FOLDER)?;
    let progress = context.progress_over(
        &format!("copying {} of {} shards", console::events(whole.events), shards.0.len()),
        whole.slots,
    );
    for (shard, from) in &shards.0 {
        for record in shard.records(from) {
            if interrupt::requested() {
                return Err(CliError::Interrupted(out.clone()));
            }
            record?.files().try_for_each(|file| copy(file, from, out))?;
            progress.step();
        }
    }
    drop(progress);
    let completed = complete(out, whole, &shards, context)?;
    folder.finish()?;
    let more = format!("the {} shards are no longer needed", shards.0.len());
    announce(out, &completed, arguments.output, &more)
}

/// All shards of one dataset, in order, with their folders; never empty.
struct Shards(Vec<(Shard, PathBuf)>);

impl Shards {
    /// Reads shards in any order and checks that they are complete and belong together.
    fn read(folders: &[PathBuf]) -> Result<Self, CliError> {
        let mut shards = Vec::new();
        for folder in folders {
            let file = folder.join(SHARD_FILE);
            if folder.is_dir() && !file.exists() {
                let sentence = format!("{}: holds no finished shard (no {SHARD_FILE})", folder.display());
                return Err(CliError::Usage(sentence));
            }
            shards.push((Shard::read(folder)?, folder.clone()));
        }
        shards.sort_by_key(|(shard, _)| shard.shard);
        let Some((first, place)) = shards.first() else {
            return Err(CliError::Usage("merge needs the folders of all shards".into()));
        };
        for (shard, folder) in &shards {
            let same_program = shard.fingerprint == first.fingerprint;
            if shard.of != first.of || shard.whole != first.whole || !same_program {
                return Err(CliError::Usage(format!(
                    "{}: is no shard of the same run of the same program as {}",
                    folder.display(),
                    place.display()
                )));
            }
        }
        for number in 1..=first.of {
            let found: Vec<&PathBuf> =
                shards.iter().filter(|(shard, _)| shard.shard == number).map(|(_, folder)| folder).collect();
            match found[..] {
                [_] => {}
                [] => return Err(CliError::Usage(format!("shard {number} of {} is missing", first.of))),
                [one, other, ..] => {
                    return Err(CliError::Usage(format!(
                        "{} and {} are both shard {number}",
                        one.display(),
                        other.display()
                    )));
                }
            }
        }
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
fn copy(file: &FileEntry, from: &Path, to: &Path) -> Result<(), CliError> {
    if file.verify(to).is_ok() {
        return Ok(());
    }
    file.verify(from)?;
    let source = file.place(from);
    let bytes = fs::read(&source).map_err(|source_error| WriteError {
        path: source,
        action: "read the file",
        source: source_error,
    })?;
    Ok(atomic::write(&file.place(to), &bytes)?)
}
