//! Whether a dataset is complete and its files agree, and whether they are what they say they are.

pub mod derived;
mod origin;
mod replay;

use crate::{
    error::RunError,
    listener::Listener,
    parallel::{self, make_all},
    words,
};
use phase_dataset::{
    manifest::{MANIFEST_FILE, Manifest},
    preset::Preset,
    verify::{Check, verify_with, work},
};
use phase_files::{
    FileError, Problem,
    checksum::FileEntry,
    folder::{self, Contents, FolderError},
    regular, shown,
};
use phase_model::random::{self, Purpose};
use phase_sim::SimulationSettings;
use rand::seq::SliceRandom;
use std::{
    fs,
    path::{Path, PathBuf},
};

/// Checks that are made beside the files themselves.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Checks {
    /// SHA-256 of the manifest in hexadecimal, from a trusted place: with it no change at all goes unnoticed.
    pub digest: Option<String>,
    /// Whether to derive again what follows from the recorded actions and from the preset: motion in the
    /// engine named, labels, scenes, seeds and splits, videos, and every file that describes the whole.
    pub replay: bool,
    /// Number of events to simulate again, thoughts and all.
    pub resimulate: Option<usize>,
    /// Seed of the choice of these events.
    pub resimulate_seed: u64,
    /// File of the preset for `replay`, if it is not bundled.
    pub preset: Option<PathBuf>,
}

/// Opens a finished dataset for [`problems`]: its manifest.
///
/// # Errors
/// [`RunError::Unfinished`], [`RunError::Usage`] if there is no manifest, or a [`RunError::File`] if it
/// cannot be used.
pub fn open(folder: &Path) -> Result<Manifest, RunError> {
    match folder::inspect(folder, MANIFEST_FILE) {
        Ok(Contents::Finished) => Ok(manifest(folder)?),
        Ok(Contents::Unfinished(_)) | Err(FolderError::EarlierRun(_)) => {
            Err(RunError::Unfinished(folder.to_owned()))
        }
        _ => {
            let rule = "holds no manifest.json; give the folder of a finished dataset";
            Err(RunError::Usage(format!("{}: {rule}", folder.display())))
        }
    }
}

/// Reads the manifest of a dataset, which has to be a file: nothing is waited for.
///
/// # Errors
/// If it is none, or cannot be used.
pub fn manifest(folder: &Path) -> Result<Manifest, FileError> {
    let file = folder.join(MANIFEST_FILE);
    let problem = match fs::symlink_metadata(&file) {
        Ok(about) if about.is_file() => return Manifest::read(&file),
        Ok(about) if about.is_symlink() => Problem::Link,
        Ok(_) => Problem::NoFile,
        Err(error) => Problem::Unreadable(error),
    };
    Err(FileError { file, problem })
}

/// Everything that is wrong with a dataset. Deeper checks are made of what no cheaper one has found wrong.
///
/// # Errors
/// If the preset that is given cannot be used, [`RunError::Threads`], [`RunError::Interrupted`], or if
/// nothing can be written into the system's folder for temporary files.
pub fn problems(
    folder: &Path,
    manifest: &Manifest,
    checks: &Checks,
    threads: Option<usize>,
    listener: &dyn Listener,
) -> Result<Vec<FileError>, RunError> {
    if let Some(preset) = &checks.preset {
        Preset::parse(preset, &regular::text(preset)?)?;
    }
    let threads = parallel::threads(threads);
    let activity = format!("verifying {}", words::events(manifest.events.len()));
    let progress = listener.progress_over(&activity, work(manifest));
    let run = |count: usize, check: &Check<'_>| {
        let answers = make_all(threads, count, |k| Ok(Some(check(k))))?;
        // There is always a result: interruptions are not handled here, and nothing is written.
        Ok::<_, RunError>(answers.unwrap_or_default())
    };
    let mut noted = |path: &Path| listener.note(&format!("note: {}: is no part of the dataset", shown(path)));
    let mut problems = verify_with(folder, manifest, &|steps| progress.steps(steps), &mut noted, run)?;
    drop(progress);
    // Those of the events are the same but for lengths, which the check of an event compares with its rows.
    if let Err(error) = SimulationSettings::read(&manifest.settings, "settings") {
        let problem = Problem::Shape { what: "manifest", rule: error.to_string() };
        problems.push(FileError { file: folder.join(MANIFEST_FILE), problem });
    }
    let digest = FileEntry::of(folder, MANIFEST_FILE)?.sha256;
    if checks.digest.as_ref().is_some_and(|expected| *expected != digest) {
        let file = folder.join(MANIFEST_FILE);
        problems.push(FileError { file, problem: Problem::Differs("the digest that was given".into()) });
    }
    if problems.is_empty() && checks.replay {
        problems = replay::problems(folder, manifest, checks, threads, listener)?;
    }
    if let (true, Some(count)) = (problems.is_empty(), checks.resimulate) {
        let mut events: Vec<usize> = (0..manifest.events.len()).collect();
        events.shuffle(&mut random::stream(checks.resimulate_seed, Purpose::Event, 0));
        events.truncate(count);
        events.sort_unstable();
        problems = replay::simulated_again(folder, manifest, &events, threads, listener)?;
    }
    Ok(problems)
}
