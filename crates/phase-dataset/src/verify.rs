//! Whether a dataset's folder contains exactly what its manifest lists, and whether its files agree with each
//! other.

use crate::{
    FileError, Problem,
    checksum::FileEntry,
    croissant::{CROISSANT_FILE, checksums},
    event_set::{PairEntry, SetEntry},
    json,
    manifest::{CARD_FILE, EventEntry, MANIFEST_FILE, Manifest, PAGE_FILE},
    overview::Overview,
    parquet::{self, ParquetFile},
};
use core::convert::Infallible;
use phase_event::{Event, EventReadError, Recording};
use phase_model::json::{FieldError, shown};
use serde_json::Value;
use std::{
    collections::{BTreeMap, BTreeSet},
    fs, io,
    path::Path,
};

/// One of several independent checks, by its number; the result is the problem found, if any.
pub type Check<'a> = dyn Fn(usize) -> Option<FileError> + Sync + 'a;

/// Everything that is wrong with a finished dataset, one error for each problem: files that are missing,
/// changed or extra, and event files, Parquet files and descriptions that contradict the manifest. The
/// contents of a damaged file are not checked. Files are read one after the other; besides the manifest, one
/// group of events is in memory.
#[must_use]
pub fn verify(folder: &Path, manifest: &Manifest) -> Vec<FileError> {
    let in_order =
        |count: usize, check: &Check<'_>| Ok::<_, Infallible>((0..count).map(check).collect::<Vec<_>>());
    let Ok(problems) = verify_with(folder, manifest, &|_| {}, in_order);
    problems
}

/// As [`verify`], with an executor: `run` performs the given number of checks, numbered from 0, in any order and
/// on any threads, and returns the results by number. `done` receives the share of [`work`] of each check.
///
/// # Errors
/// Those of `run`.
pub fn verify_with<E>(
    folder: &Path,
    manifest: &Manifest,
    done: &(dyn Fn(usize) + Sync),
    run: impl Fn(usize, &Check<'_>) -> Result<Vec<Option<FileError>>, E>,
) -> Result<Vec<FileError>, E> {
    let mut problems = Vec::new();
    let files = listed(folder, manifest, &mut problems);
    let entries: Vec<&FileEntry> = files.values().copied().collect();
    let answers = run(entries.len(), &|k| {
        let answer = entries[k].verify(folder).err();
        done(1);
        answer
    })?;
    let mut broken: BTreeSet<&str> = BTreeSet::new();
    for (entry, problem) in entries.iter().zip(answers) {
        broken.extend(problem.is_some().then_some(entry.path.as_str()));
        problems.extend(problem);
    }
    extra(folder, folder, &files, &mut problems);
    let answers = run(manifest.events.len(), &|k| {
        let entry = &manifest.events[k];
        let whole = !broken.contains(entry.event.path.as_str());
        let answer = whole.then(|| event(folder, entry).err()).flatten();
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
            problems.push(FileError { file: folder.join(path), problem: Problem::Unlisted });
        }
    }
    let is_part = |path: &str| parts.iter().any(|part| part.path == path);
    let in_data = |path: &&str| path.starts_with(&format!("{}/", parquet::FOLDER));
    for path in files.keys().copied().filter(in_data).filter(|path| !is_part(path)) {
        problems.push(FileError { file: folder.join(path), problem: Problem::Eventless });
    }
    let readable = |path: &str| files.contains_key(path) && !broken.contains(path);
    if readable(CROISSANT_FILE) {
        problems.extend(croissant(folder, &files).err());
    }
    let members = members(manifest);
    let sets = run(manifest.sets.len(), &|k| {
        let set = &manifest.sets[k];
        let members = members.get(set.id.as_str()).map_or(&[][..], Vec::as_slice);
        let whole = members.iter().all(|entry| readable(&entry.event.path));
        whole.then(|| pairs(folder, set, members).err()).flatten()
    })?;
    problems.extend(sets.into_iter().flatten());
    let with_events = parts.iter().map(|part| (part, part.of(&manifest.events)));
    let whole = |(part, events): &(&ParquetFile, Vec<&EventEntry>)| {
        readable(&part.path) && events.iter().all(|entry| readable(&entry.event.path))
    };
    problems.extend(compare(folder, &with_events.filter(whole).collect::<Vec<_>>(), done, run)?);
    Ok(problems)
}

/// The amount of work: every file, every event's file again, and every event's row.
#[must_use]
pub fn work(manifest: &Manifest) -> usize {
    4 * manifest.events.len() + manifest.files.len()
}

/// Compares Parquet files with the event files, share by share; one error for each file.
fn compare<E>(
    folder: &Path,
    parts: &[(&ParquetFile, Vec<&EventEntry>)],
    done: &(dyn Fn(usize) + Sync),
    run: impl Fn(usize, &Check<'_>) -> Result<Vec<Option<FileError>>, E>,
) -> Result<Vec<FileError>, E> {
    let of_part = |number: usize| (0..parquet::shares(parts[number].0)).map(move |share| (number, share));
    let shares: Vec<(usize, usize)> = (0..parts.len()).flat_map(of_part).collect();
    let answers = run(shares.len(), &|k| {
        let (number, share) = shares[k];
        let (part, events) = &parts[number];
        let answer = parquet::compare_share(folder, part, events, share).err();
        done(part.events / parquet::shares(part));
        answer
    })?;
    let mut found: BTreeMap<usize, FileError> = BTreeMap::new();
    for ((number, _), problem) in shares.iter().zip(answers) {
        if let Some(problem) = problem {
            found.entry(*number).or_insert(problem);
        }
    }
    Ok(found.into_values().collect())
}

/// The files that the manifest names, by path; every path and every id may be named once.
fn listed<'a>(
    folder: &Path,
    manifest: &'a Manifest,
    problems: &mut Vec<FileError>,
) -> BTreeMap<&'a str, &'a FileEntry> {
    let mut fail = |problem| problems.push(FileError { file: folder.join(MANIFEST_FILE), problem });
    let mut ids = BTreeSet::new();
    for event in &manifest.events {
        if !ids.insert(&event.id) {
            fail(EventReadError::DuplicateId(event.id.clone()).into());
        }
    }
    let mut files = BTreeMap::new();
    for file in manifest.all_files() {
        if files.insert(file.path.as_str(), file).is_some() {
            fail(Problem::DuplicatePath(file.path.clone()));
        }
    }
    files
}

/// Files below a folder that the manifest does not name. Links are files here, so nothing outside is looked at.
fn extra(root: &Path, folder: &Path, files: &BTreeMap<&str, &FileEntry>, problems: &mut Vec<FileError>) {
    let entries = match fs::read_dir(folder).and_then(Iterator::collect::<io::Result<Vec<_>>>) {
        Ok(entries) => entries,
        Err(error) => {
            let problem = Problem::Unreadable(error);
            return problems.push(FileError { file: folder.to_owned(), problem });
        }
    };
    let mut paths: Vec<_> = entries.iter().map(|entry| (entry.path(), entry.file_type())).collect();
    paths.sort_by(|a, b| a.0.cmp(&b.0));
    for (path, kind) in paths {
        if kind.is_ok_and(|kind| kind.is_dir()) {
            extra(root, &path, files, problems);
            continue;
        }
        let parts = path.strip_prefix(root).unwrap_or(&path).components();
        let name = parts.map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/");
        if name != MANIFEST_FILE && !files.contains_key(name.as_str()) {
            problems.push(FileError { file: path, problem: Problem::Extra });
        }
    }
}

/// Checks that an event's file agrees with the manifest.
fn event(folder: &Path, entry: &EventEntry) -> Result<(), FileError> {
    let file = folder.join(&entry.event.path);
    let recording = parquet::read(folder, entry)?;
    let fail = |field: &str, rule: String| {
        let problem = FieldError { field: field.into(), rule };
        FileError {
            file: file.clone(),
            problem: EventReadError::Field { event: Some(recording.id.clone()), problem }.into(),
        }
    };
    let Some(simulation) = &recording.simulation else {
        return Err(fail("substeps", "is missing".into()));
    };
    let (json, video) = (entry.event.clone(), entry.video.clone());
    let mut found = EventEntry::with_files(&recording.id, &simulation.event, json, video);
    found.relation = recording.relation;
    (found.variant, found.split, found.set) = (entry.variant, entry.split, entry.set.clone());
    let encode = |entry: &EventEntry| {
        serde_json::to_value(entry)
            .map_err(|error| FileError { file: file.clone(), problem: Problem::Encode(error) })
    };
    let (found, expected) = (encode(&found)?, encode(entry)?);
    let members = expected.as_object().into_iter().flatten();
    match members.into_iter().find(|(key, value)| found.get(key.as_str()) != Some(value)) {
        Some((key, value)) => {
            let found = found.get(key).map_or_else(String::new, shown);
            Err(fail(key, format!("is {found}, but the manifest says {}", shown(value))))
        }
        None => Ok(()),
    }
}

/// The events of each set, in order.
fn members(manifest: &Manifest) -> BTreeMap<&str, Vec<&EventEntry>> {
    let mut members: BTreeMap<&str, Vec<&EventEntry>> = BTreeMap::new();
    for entry in &manifest.events {
        if let Some(place) = &entry.set {
            members.entry(&place.set).or_default().push(entry);
        }
    }
    members
}

/// Checks that the events of a set part where the manifest says.
fn pairs(folder: &Path, set: &SetEntry, members: &[&EventEntry]) -> Result<(), FileError> {
    let read = |entry: &&EventEntry| parquet::read(folder, entry);
    let recordings: Vec<Recording> = members.iter().map(read).collect::<Result<_, _>>()?;
    let simulated = |recording: &Recording| recording.simulation.as_ref().map(|it| it.event.clone());
    let events: Vec<(&str, Event)> =
        recordings.iter().filter_map(|it| Some((it.id.as_str(), simulated(it)?))).collect();
    let named: Vec<(&str, &Event)> = events.iter().map(|(id, event)| (*id, event)).collect();
    if PairEntry::all(&named) == set.pairs {
        return Ok(());
    }
    let rule = format!("field `pairs` of the set {} is not what its events show", set.id);
    Err(FileError {
        file: folder.join(MANIFEST_FILE),
        problem: Problem::Shape { what: "dataset manifest", rule },
    })
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
            Err(FileError { file, problem: problem.into() })
        }
        None => Ok(()),
    }
}
