//! Whether a dataset's folder contains exactly what its manifest lists, and whether its files agree with each
//! other.
//!
//! Nothing is simulated or drawn for this; `docs/explanation/reliability.md` states what can be found in this
//! way and what cannot.

mod events;
mod files;
mod video;

use crate::DatasetProblem;
use crate::{
    croissant::{CROISSANT_FILE, checksums},
    manifest::{CARD_FILE, EventEntry, Manifest, PAGE_FILE},
    overview::Overview,
    parquet::{self, ParquetFile},
};
use core::convert::Infallible;
use phase_event::EventReadError;
use phase_files::{FileError, Problem, checksum::FileEntry, json};
use phase_model::json::FieldError;
use serde_json::Value;
use std::{
    collections::{BTreeMap, BTreeSet},
    path::Path,
};

/// One of several independent checks, by its number; the result is the problem found, if any.
pub type Check<'a> = dyn Fn(usize) -> Option<FileError> + Sync + 'a;

/// Everything that is wrong with a finished dataset, one error for each problem: files that are missing,
/// changed or extra (but not those that systems and tools leave), links, special files, a manifest or events
/// that are not in the form in which they are written, videos that are cut or of another length than their
/// events, and event files, Parquet files and descriptions that contradict the manifest. The contents of a
/// damaged file are not checked. Files are read one after the other; besides the manifest and its text, one
/// group of events is in memory.
#[must_use]
pub fn verify(folder: &Path, manifest: &Manifest) -> Vec<FileError> {
    let in_order =
        |count: usize, check: &Check<'_>| Ok::<_, Infallible>((0..count).map(check).collect::<Vec<_>>());
    let Ok(problems) = verify_with(folder, manifest, &|_| {}, &mut |_| {}, in_order);
    problems
}

/// As [`verify`], with an executor: `run` performs the given number of checks, numbered from 0, in any order
/// and on any threads, and returns the results by number. `done` receives the share of [`work`] of each
/// check, `noted` each path that is no damage, because systems and tools leave such things
/// ([`phase_files::incidental`]).
///
/// # Errors
/// Those of `run`.
pub fn verify_with<E>(
    folder: &Path,
    manifest: &Manifest,
    done: &(dyn Fn(usize) + Sync),
    noted: &mut dyn FnMut(&Path),
    run: impl Fn(usize, &Check<'_>) -> Result<Vec<Option<FileError>>, E>,
) -> Result<Vec<FileError>, E> {
    let mut problems = Vec::new();
    files::manifest(folder, manifest, &mut problems);
    let files = files::listed(folder, manifest, &mut problems);
    problems.extend(events::names(folder, manifest));
    let mut broken: BTreeSet<&str> = BTreeSet::new();
    let mut foreign = Vec::new();
    files::foreign(folder, &files, &mut broken, &mut foreign, noted);
    let entries: Vec<&FileEntry> = files.values().copied().collect();
    let answers = run(entries.len(), &|k| {
        let is_file = !broken.contains(entries[k].path.as_str());
        let answer = is_file.then(|| entries[k].verify(folder).err()).flatten();
        done(1);
        answer
    })?;
    for (entry, problem) in entries.iter().zip(answers) {
        broken.extend(problem.is_some().then_some(entry.path.as_str()));
        problems.extend(problem);
    }
    problems.extend(foreign);
    let answers = run(manifest.events.len(), &|k| {
        let entry = &manifest.events[k];
        let whole = entry.files().all(|file| !broken.contains(file.path.as_str()));
        let answer = whole.then(|| events::check(folder, manifest, entry).err()).flatten();
        done(1);
        answer
    })?;
    for (entry, problem) in manifest.events.iter().zip(answers) {
        broken.extend(problem.is_some().then_some(entry.event.path.as_str()));
        problems.extend(problem);
    }
    let parts = parquet::parts(&Overview::of(manifest).splits);
    // The page exists only if there are videos.
    let page = manifest.events.iter().any(|event| event.video.is_some()).then_some(PAGE_FILE);
    let described = [CARD_FILE, CROISSANT_FILE].into_iter().chain(page);
    for path in described.chain(parts.iter().map(|part| part.path.as_str())) {
        if !files.contains_key(path) {
            problems.push(FileError { file: folder.join(path), problem: DatasetProblem::Unlisted.into() });
        }
    }
    let is_part = |path: &str| parts.iter().any(|part| part.path == path);
    let in_data = |path: &&str| path.starts_with(&format!("{}/", parquet::FOLDER));
    for path in files.keys().copied().filter(in_data).filter(|path| !is_part(path)) {
        problems.push(FileError { file: folder.join(path), problem: DatasetProblem::Eventless.into() });
    }
    let readable = |path: &str| files.contains_key(path) && !broken.contains(path);
    if readable(CROISSANT_FILE) {
        problems.extend(croissant(folder, &files).err());
    }
    let members = events::members(manifest);
    let sets = run(manifest.sets.len(), &|k| {
        let set = &manifest.sets[k];
        let members = members.get(set.id.as_str()).map_or(&[][..], Vec::as_slice);
        let whole = members.iter().all(|entry| readable(entry.event.path.as_str()));
        let video = set.video.as_ref().is_none_or(|video| readable(video.path.as_str()));
        (whole && video).then(|| events::pairs(folder, &manifest.form, set, members).err()).flatten()
    })?;
    problems.extend(sets.into_iter().flatten());
    let with_events: Vec<(&ParquetFile, Vec<&EventEntry>)> =
        parts.iter().map(|part| (part, part.of(&manifest.events))).collect();
    let tables = run(with_events.len(), &|k| {
        let (part, events) = &with_events[k];
        let whole = readable(&part.path) && events.iter().all(|entry| readable(entry.event.path.as_str()));
        let answer = whole.then(|| parquet::compare(folder, part, events).err()).flatten();
        done(part.events);
        answer
    })?;
    problems.extend(tables.into_iter().flatten());
    Ok(problems)
}

/// The amount of work: every file, every event's file again, and every event's row.
#[must_use]
pub fn work(manifest: &Manifest) -> usize {
    4 * manifest.events.len() + manifest.files.len()
}

/// Checks that the description's checksums are the manifest's.
fn croissant(folder: &Path, files: &BTreeMap<&str, &FileEntry>) -> Result<(), FileError> {
    let file = folder.join(CROISSANT_FILE);
    let description: Value = json::read(&file)?;
    let named = checksums(&description);
    let differs = |path: &str, sum: &str| files.get(path).is_none_or(|entry| entry.sha256 != sum);
    let wrong = named.iter().find(|(path, sum)| differs(path, sum)).map(|(path, _)| *path);
    let is_data = |path: &&str| path.ends_with(".parquet") && !named.iter().any(|(named, _)| named == path);
    match wrong.or_else(|| files.keys().copied().find(is_data)) {
        Some(path) => {
            let problem = EventReadError::Field {
                event: None,
                problem: FieldError {
                    field: "distribution".into(),
                    rule: format!("does not give the checksum of {path} that the manifest gives"),
                },
            };
            Err(FileError { file, problem: Problem::content(problem) })
        }
        None => Ok(()),
    }
}
