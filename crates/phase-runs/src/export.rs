//! Export of a dataset as WebDataset: tar files that training programs read from the first byte to the last.
//!
//! A sample is an event: `<id>.mp4`, `<id>.json` with its labels, the entry of the manifest, and
//! `<id>.phase-events`, its file of the format `phase-events/1`.

use crate::{error::RunError, interrupt, listener::Listener, words};
use phase_dataset::{
    manifest::{EventEntry, MANIFEST_FILE, Manifest},
    splits::Split,
};
use phase_files::{
    FileError, Problem, WriteError,
    atomic::{self, AtomicFile},
    checksum::FileEntry,
    folder::{self, Contents, Folder},
    regular,
    run::Run,
};
use serde_json::{Value, json};
use std::{fs, path::Path};
use tar::{Builder, Header};

/// The list of all tar files; written last.
const INDEX_FILE: &str = "index.json";
/// The value of its field `format`.
const INDEX_FORMAT: &str = "phase-webdataset/1";

/// An export that is there.
#[derive(Clone, PartialEq, Debug)]
pub struct Exported {
    /// The tar files: `file`, `split` and `events` of each.
    pub files: Vec<Value>,
    /// Whether it was made now.
    pub is_new: bool,
}

/// Exports the finished dataset in a folder into another, which is new, empty, or of the same export: this
/// number of events to a tar file. The same dataset gives the same bytes; tar files that are complete are
/// kept after an interruption.
///
/// # Errors
/// If the dataset or the folder cannot be used, a file cannot be written, or a stop was requested.
pub fn export(
    from: &Path,
    out: &Path,
    events_per_file: usize,
    listener: &dyn Listener,
) -> Result<Exported, RunError> {
    let manifest_file = from.join(MANIFEST_FILE);
    if !from.exists() {
        return Err(RunError::Usage(format!("{}: does not exist", from.display())));
    }
    if !manifest_file.is_file() {
        return Err(RunError::NotADataset(from.to_owned()));
    }
    let manifest = Manifest::read(&manifest_file)?;
    let digest = FileEntry::of(from, MANIFEST_FILE)?.sha256;
    let run = Run::new([
        ("command", "export".into()),
        ("manifest_sha256", digest.into()),
        ("events_per_file", events_per_file.into()),
    ]);
    match folder::inspect(out, INDEX_FILE)? {
        Contents::Finished => {
            let index: Value = phase_files::json::read(&out.join(INDEX_FILE))?;
            run.check(out, "a finished", &index["run"])?;
            folder::remove_leftovers(out, &run)?;
            let files = index["files"].as_array().cloned().unwrap_or_default();
            return Ok(Exported { files, is_new: false });
        }
        Contents::Unfinished(other) => {
            run.check(out, "an unfinished", &other)?;
            listener.note(&format!("continuing in {}", out.display()));
        }
        Contents::Nothing => {}
    }
    let folder = Folder::claim(out, &run)?;
    let progress = listener
        .progress_over(&format!("exporting {}", words::events(manifest.events.len())), manifest.events.len());
    let mut files = Vec::new();
    for split in Split::ALL {
        let events: Vec<&EventEntry> =
            manifest.events.iter().filter(|entry| entry.split() == split).collect();
        for (k, events) in events.chunks(events_per_file).enumerate() {
            let name = format!("{}-{k:05}.tar", split.name());
            if !out.join(&name).exists() {
                write(from, &out.join(&name), events)?;
            }
            if interrupt::requested() {
                return Err(RunError::Interrupted(out.to_owned()));
            }
            progress.steps(events.len());
            let entry = FileEntry::of(out, name).map_err(RunError::ReadBack)?;
            files.push(json!({ "file": entry, "split": split, "events": events.len() }));
        }
    }
    drop(progress);
    let index = json!({ "format": INDEX_FORMAT, "run": run, "files": files });
    atomic::write_json(&out.join(INDEX_FILE), &index)?;
    folder.finish()?;
    Ok(Exported { files, is_new: true })
}

/// Writes one tar file.
fn write(from: &Path, path: &Path, events: &[&EventEntry]) -> Result<(), RunError> {
    let failed = |source| WriteError { path: path.to_owned(), action: "write the file", source };
    let mut tar = Builder::new(AtomicFile::create(path)?);
    for entry in events {
        let mut labels =
            serde_json::to_value(entry).map_err(|source| RunError::Serialise { what: "labels", source })?;
        // Loaders infer signed integers, which some seeds exceed.
        labels["seed"] = entry.seed.to_string().into();
        let id = &entry.id;
        let video = entry.video.as_ref().map(|video| (format!("{id}.mp4"), video));
        let event = (format!("{id}.phase-events"), &entry.event);
        append(&mut tar, &format!("{id}.json"), labels.to_string().as_bytes()).map_err(failed)?;
        for (name, file) in [event].into_iter().chain(video) {
            append(&mut tar, &name, &whole(from, file)?).map_err(failed)?;
        }
    }
    tar.into_inner().map_err(failed)?.commit()?;
    Ok(())
}

/// Adds a file without owner and time, so that the same events give the same bytes.
fn append(tar: &mut Builder<AtomicFile>, name: &str, bytes: &[u8]) -> std::io::Result<()> {
    let mut header = Header::new_ustar();
    header.set_size(bytes.len() as u64);
    header.set_mode(0o644);
    header.set_mtime(0);
    tar.append_data(&mut header, name, bytes)
}

/// The bytes of a file that is as its dataset's manifest says.
fn whole(from: &Path, file: &FileEntry) -> Result<Vec<u8>, RunError> {
    file.verify(from).map_err(RunError::Altered)?;
    Ok(regular::bytes(&file.place(from))?)
}
