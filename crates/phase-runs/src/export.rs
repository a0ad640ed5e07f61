//! `export`: a dataset as WebDataset, tar files that training programs read from the first byte to the last.
//!
//! A sample is an event: `<id>.mp4`, `<id>.json` with its labels, the entry of the manifest, and `<id>.phase-events`, its file
//! of the format `phase-events/1`.

use crate::{console, context::Context, error::CliError, interrupt, output::Output};
use clap::{Args, value_parser};
use phase_dataset::{
    manifest::{EventEntry, MANIFEST_FILE, Manifest},
    splits::Split,
};
use phase_files::{
    FileError, Problem, WriteError,
    atomic::{self, AtomicFile},
    checksum::FileEntry,
    folder::{self, Contents, Folder},
    run::Run,
};
use serde_json::{Value, json};
use std::{
    fs,
    path::{Path, PathBuf},
};
use tar::{Builder, Header};

/// The list of all tar files; written last.
const INDEX_FILE: &str = "index.json";
/// The value of its field `format`.
const INDEX_FORMAT: &str = "phase-webdataset/1";

/// Options of `export`.
#[derive(Args, Debug)]
pub struct Export {
    /// Folder of a finished dataset
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Folder for the tar files; new, empty, or of the same export
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Events in a tar file
    #[arg(long, value_name = "N", default_value_t = 500, value_parser = value_parser!(u32).range(1..=1_000_000))]
    pub events_per_file: u32,
    /// How the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Runs the command. The same dataset gives the same bytes; tar files that are complete are kept after an interruption.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &Export, context: &Context) -> Result<(), CliError> {
    let (from, out) = (&arguments.folder, &arguments.out);
    let manifest_file = from.join(MANIFEST_FILE);
    if !from.exists() {
        return Err(CliError::Usage(format!("{}: does not exist", from.display())));
    }
    if !manifest_file.is_file() {
        return Err(CliError::NotADataset(from.clone()));
    }
    let manifest = Manifest::read(&manifest_file)?;
    let digest = FileEntry::of(from, MANIFEST_FILE)?.sha256;
    let run = Run::new([
        ("command", "export".into()),
        ("manifest_sha256", digest.into()),
        ("events_per_file", arguments.events_per_file.into()),
    ]);
    match folder::inspect(out, INDEX_FILE)? {
        Contents::Finished => {
            let index: Value = phase_files::json::read(&out.join(INDEX_FILE))?;
            run.check(out, "a finished", &index["run"])?;
            folder::remove_leftovers(out, &run)?;
            return announce(arguments, &index, false);
        }
        Contents::Unfinished(other) => {
            run.check(out, "an unfinished", &other)?;
            context.note(format!("continuing in {}", out.display()));
        }
        Contents::Nothing => {}
    }
    interrupt::listen();
    let folder = Folder::claim(out, &run)?;
    let progress = context.progress_over(
        &format!("exporting {}", console::events(manifest.events.len())),
        manifest.events.len(),
    );
    let mut files = Vec::new();
    for split in Split::ALL {
        let events: Vec<&EventEntry> =
            manifest.events.iter().filter(|entry| entry.split() == split).collect();
        for (k, events) in events.chunks(arguments.events_per_file as usize).enumerate() {
            let name = format!("{}-{k:05}.tar", split.name());
            if !out.join(&name).exists() {
                write(from, &out.join(&name), events)?;
            }
            if interrupt::requested() {
                return Err(CliError::Interrupted(out.clone()));
            }
            progress.steps(events.len());
            let entry = FileEntry::of(out, name).map_err(CliError::ReadBack)?;
            files.push(json!({ "file": entry, "split": split, "events": events.len() }));
        }
    }
    drop(progress);
    let index = json!({ "format": INDEX_FORMAT, "run": run, "files": files });
    atomic::write_json(&out.join(INDEX_FILE), &index)?;
    folder.finish()?;
    announce(arguments, &index, true)
}

fn announce(arguments: &Export, index: &Value, new: bool) -> Result<(), CliError> {
    let (out, count) = (&arguments.out, index["files"].as_array().map_or(0, Vec::len));
    let text = if new {
        format!("{count} tar files in {}", out.display())
    } else {
        format!("{} holds this export already", out.display())
    };
    arguments.output.print(text, &json!({ "folder": out, "files": index["files"], "new": new }))
}

/// Writes one tar file.
fn write(from: &Path, path: &Path, events: &[&EventEntry]) -> Result<(), CliError> {
    let failed = |source| WriteError { path: path.to_owned(), action: "write the file", source };
    let mut tar = Builder::new(AtomicFile::create(path)?);
    for entry in events {
        let mut labels =
            serde_json::to_value(entry).map_err(|source| CliError::Serialise { what: "labels", source })?;
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
fn whole(from: &Path, file: &FileEntry) -> Result<Vec<u8>, CliError> {
    file.verify(from).map_err(CliError::Altered)?;
    let path = file.place(from);
    fs::read(&path).map_err(|error| FileError { file: path, problem: Problem::Unreadable(error) }.into())
}
