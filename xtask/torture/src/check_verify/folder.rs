//! The dataset that is edited, and copies of it.

use crate::error::TortureError;
use phase_dataset::{
    croissant::CROISSANT_FILE,
    manifest::{EventEntry, MANIFEST_FILE, Manifest},
    phase_events,
};
use phase_event::Recording;
use phase_files::{WriteError, atomic, checksum::FileEntry};
use phase_model::random::Pcg64Mcg;
use phase_runs::{
    error::RunError,
    listener::Silent,
    verify::{self, derived},
};
use rand::seq::{IndexedRandom, SliceRandom};
use std::{
    collections::BTreeMap,
    fs, io,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};
use tempfile::TempDir;

/// A preset with all three splits, whose events are short.
const PRESET: &str = r#"{
  "format": "phase-preset/3", "name": "small", "seed": 7, "layouts": {"all": [0, 4, 8, 12, 16, 20]},
  "groups": [
    {"variant": "chase", "split": "train", "layouts": "all", "events": 2},
    {"variant": "carry", "split": "validation", "layouts": "all", "events": 1},
    {"variant": "lift", "split": "test", "layouts": "all", "events": 1},
    {"variant": "places", "split": "test", "layouts": "all", "events": 1}
  ]
}"#;
/// The file that it is written into.
const PRESET_FILE: &str = "small.json";
/// Options that make its events quickly.
const OPTIONS: [&str; 6] = ["--simulations", "30", "--particles", "6", "--max-steps", "6"];

/// Mending of traces that betray an edit.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Mends {
    /// Not at all.
    Nothing,
    /// The manifest's digest.
    Digest,
    /// The checksums of changed files, in the manifest and in `croissant.json`, and the digest.
    Checksums,
    /// Every file that describes the events, written by PHASE itself.
    Everything,
}

impl Mends {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Nothing => "nothing",
            Self::Digest => "digest",
            Self::Checksums => "checksums",
            Self::Everything => "everything",
        }
    }
}

/// The dataset, and another from another seed.
pub(super) struct Original {
    scratch: TempDir,
    digest: String,
}

impl Original {
    pub(super) fn make() -> Result<Self, TortureError> {
        let scratch =
            tempfile::tempdir().map_err(|source| failed(Path::new("."), "create a folder", source))?;
        let preset = scratch.path().join(PRESET_FILE);
        write(&preset, PRESET.as_bytes())?;
        for (name, seed) in [("original", "7"), ("other", "8")] {
            let out = scratch.path().join(name);
            let mut command = Command::new(std::env::current_exe().map_err(TortureError::Start)?);
            command.args(["gen-dataset", "--quiet", "--seed", seed, "--preset"]).arg(&preset);
            command.arg("--out").arg(&out).args(OPTIONS).stdout(Stdio::null());
            if !command.status().map_err(TortureError::Start)?.success() {
                let problem = "the dataset to be edited cannot be made".into();
                return Err(TortureError::Undisturbed { what: "gen-dataset", problem });
            }
        }
        let digest = FileEntry::of(&scratch.path().join("original"), MANIFEST_FILE).map_err(cli)?.sha256;
        Ok(Self { scratch, digest })
    }

    fn path(&self) -> PathBuf {
        self.scratch.path().join("original")
    }

    /// The file of its preset.
    pub(super) fn preset(&self) -> PathBuf {
        self.scratch.path().join(PRESET_FILE)
    }

    /// A genuine dataset that is not this one.
    pub(super) fn other(&self) -> PathBuf {
        self.scratch.path().join("other")
    }

    pub(super) fn digest(&self) -> &str {
        &self.digest
    }

    pub(super) fn copy(&self) -> Result<EditedCopy, TortureError> {
        let scratch =
            tempfile::tempdir().map_err(|source| failed(Path::new("."), "create a folder", source))?;
        let mut copy = EditedCopy { scratch, manifest: verify::manifest(&self.path()).map_err(cli)? };
        copy.fill(&self.path())?;
        Ok(copy)
    }

    /// Whether a copy is not the dataset any more.
    pub(super) fn differs(&self, copy: &EditedCopy) -> Result<bool, TortureError> {
        Ok(tree(&self.path())? != tree(&copy.path())?)
    }
}

/// A copy that is edited.
pub(super) struct EditedCopy {
    scratch: TempDir,
    /// Its manifest, as it was.
    pub(super) manifest: Manifest,
}

impl EditedCopy {
    pub(super) fn path(&self) -> PathBuf {
        self.scratch.path().join("dataset")
    }

    /// A place beside it.
    pub(super) fn beside(&self) -> PathBuf {
        self.scratch.path().join("beside")
    }

    /// Replaces it by a dataset.
    pub(super) fn fill(&mut self, from: &Path) -> Result<(), TortureError> {
        let to = self.path();
        if to.exists() {
            fs::remove_dir_all(&to).map_err(|source| failed(&to, "remove it", source))?;
        }
        for (name, content) in tree(from)? {
            if let Some(bytes) = content {
                write(&to.join(name), &bytes)?;
            }
        }
        self.manifest = verify::manifest(&to).map_err(cli)?;
        Ok(())
    }

    pub(super) fn read(&self, name: &str) -> Result<Vec<u8>, TortureError> {
        let path = self.path().join(name);
        fs::read(&path).map_err(|source| failed(&path, "read the file", source))
    }

    pub(super) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), TortureError> {
        write(&self.path().join(name), bytes)
    }

    /// The event of an entry.
    pub(super) fn recording(&self, entry: &EventEntry) -> Result<Recording, TortureError> {
        let recordings = phase_events::read(&entry.event.place(&self.path())).map_err(cli)?;
        recordings
            .into_iter()
            .next()
            .ok_or_else(|| RunError::Usage(format!("{}: holds no event", entry.event.path)).into())
    }

    /// Some event.
    pub(super) fn some_event(&self, random: &mut Pcg64Mcg) -> Option<&EventEntry> {
        self.manifest.events.choose(random)
    }

    /// Two events, if there are.
    pub(super) fn two_events(&self, random: &mut Pcg64Mcg) -> Option<(usize, usize)> {
        let mut places: Vec<usize> = (0..self.manifest.events.len()).collect();
        places.shuffle(random);
        Some((*places.first()?, *places.get(1)?))
    }

    pub(super) fn exchange(&self, one: &str, other: &str) -> Result<(), TortureError> {
        let first = self.read(one)?;
        let second = self.read(other)?;
        self.write(one, &second)?;
        self.write(other, &first)
    }

    /// Mends what betrays an edit, as far as somebody does. Whether it could be done: not if an event can no
    /// longer be read.
    pub(super) fn mend(&mut self, mends: Mends) -> Result<bool, TortureError> {
        let path = self.path();
        match mends {
            Mends::Nothing => Ok(true),
            Mends::Digest => {
                let digest = FileEntry::of(&path, MANIFEST_FILE).map_err(cli)?.sha256;
                phase_dataset::manifest::write_digest(&path, &digest).map_err(output)?;
                Ok(true)
            }
            Mends::Checksums => self.mend_checksums().map(|()| true),
            Mends::Everything => self.mend_everything(),
        }
    }

    fn mend_checksums(&mut self) -> Result<(), TortureError> {
        let path = self.path();
        let mut changed = Vec::new();
        let manifest = &mut self.manifest;
        let events = manifest.events.iter_mut();
        let of_events = events.flat_map(|event| [Some(&mut event.event), event.video.as_mut()]).flatten();
        let mut croissant = None;
        for entry in of_events.chain(&mut manifest.files) {
            if entry.path.as_str() == CROISSANT_FILE {
                croissant = Some(entry);
                continue;
            }
            let found = FileEntry::of(&path, entry.path.as_str()).map_err(cli)?;
            changed.push((core::mem::replace(entry, found.clone()), found));
        }
        if let Some(entry) = croissant {
            let mut text = String::from_utf8_lossy(&fs::read(path.join(CROISSANT_FILE)).unwrap_or_default())
                .into_owned();
            for (before, now) in changed {
                text = text.replace(&before.sha256, &now.sha256);
                let size = |entry: &FileEntry| format!("\"contentSize\": \"{} B\"", entry.bytes);
                if before.bytes != now.bytes && text.matches(&size(&before)).count() == 1 {
                    text = text.replace(&size(&before), &size(&now));
                }
            }
            write(&path.join(CROISSANT_FILE), text.as_bytes())?;
            *entry = FileEntry::of(&path, CROISSANT_FILE).map_err(cli)?;
        }
        Ok(self.manifest.write(&path).map_err(output)?)
    }

    fn mend_everything(&mut self) -> Result<bool, TortureError> {
        let path = self.path();
        for entry in &mut self.manifest.events {
            let Ok(recordings) = phase_events::read(&entry.event.place(&path)) else { return Ok(false) };
            let Some(simulation) = recordings.into_iter().find_map(|it| it.simulation) else {
                return Ok(false);
            };
            let found = EventEntry::of(&path, &entry.id, &simulation.event, entry.video.is_some());
            let variant = entry.variant;
            let split = entry.split;
            let set = entry.set.clone();
            *entry = EventEntry { variant, split, set, ..found.map_err(cli)? };
        }
        let Some(command) = derived::command(&path).map_err(cli)? else { return Ok(false) };
        derived::rewrite((&path, &path), &self.manifest, &command, &Silent)?;
        Ok(true)
    }
}

/// Entries of a folder, by name; without bytes for anything but regular files.
fn tree(folder: &Path) -> Result<BTreeMap<String, Option<Vec<u8>>>, TortureError> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        let entries = fs::read_dir(&next).and_then(Iterator::collect::<io::Result<Vec<_>>>);
        for entry in entries.map_err(|source| failed(&next, "read the folder", source))? {
            let path = entry.path();
            let kind = entry.file_type().map_err(|source| failed(&path, "read it", source))?;
            let name = path.strip_prefix(folder).unwrap_or(&path).to_string_lossy().into_owned();
            if kind.is_dir() {
                found.insert(format!("{name}/"), None);
                folders.push(path);
            } else if kind.is_file() {
                let bytes = fs::read(&path).map_err(|source| failed(&path, "read the file", source))?;
                found.insert(name, Some(bytes));
            } else {
                found.insert(name, None);
            }
        }
    }
    Ok(found)
}

pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), TortureError> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(|source| failed(folder, "create the folder", source))?;
    }
    Ok(atomic::write(path, bytes).map_err(output)?)
}

pub(super) fn failed(path: &Path, action: &'static str, source: io::Error) -> TortureError {
    output(WriteError { path: path.to_owned(), action, source }).into()
}

fn output(error: WriteError) -> RunError {
    RunError::Output(error)
}

pub(super) fn cli(error: phase_files::FileError) -> RunError {
    error.into()
}
