//! Source of events: a file, or the folder of a dataset.

use crate::{error::RunError, listener::Listener};
use phase_dataset::{
    manifest::{MANIFEST_FILE, Manifest},
    phase_events,
    shard::SHARD_FILE,
    splits::{Item, Split},
    summary::{SUMMARY_FILE, SimulationSummary},
};
use phase_event::{ObservedEvent, Recording, SimulationRecord};
use phase_evidence::Track;
use phase_files::{FileError, Problem};
use phase_model::path::RelativePath;
use phase_sim::SimulationSettings;
use serde_json::Value;
use std::{
    borrow::Cow,
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

/// Parts of an event that determine its judgement and simulation: its layout, bodies, labels and rows, as in
/// its file.
pub(crate) fn labels_and_rows(recording: &Recording) -> Result<Value, RunError> {
    const MEMBERS: [&str; 7] =
        ["layout", "agents", "objects", "event", "relation", "relation_human", "trajectory"];
    let without_simulation = Recording { simulation: None, ..recording.clone() };
    let text = without_simulation.to_json()?;
    let event: Value = serde_json::from_str(&text)
        .map_err(|source| RunError::Serialise { what: "the labels of an event", source })?;
    Ok(MEMBERS.iter().map(|&member| (member.to_owned(), event[member].clone())).collect())
}

/// An event whose labels may be unknown.
#[derive(Clone, Debug)]
pub struct SeenEvent<'a> {
    /// Its name.
    pub id: Cow<'a, str>,
    /// The part of it that a viewer sees.
    pub observed: Cow<'a, ObservedEvent>,
    /// All of it, if it has labels.
    pub recording: Option<Cow<'a, Recording>>,
}

/// Events of which some may have no labels.
#[derive(Debug)]
pub enum SeenInput {
    /// With labels.
    Labelled(EventInput),
    /// The events of a file without, by name.
    Unlabelled(Vec<(String, ObservedEvent)>),
}

impl SeenInput {
    /// Opens what [`EventInput::open`] opens, or a file without labels.
    ///
    /// # Errors
    /// Those of [`EventInput::open`].
    pub fn open(path: &Path, ids: &[String], listener: &dyn Listener) -> Result<Self, RunError> {
        if path.is_dir() {
            return EventInput::open(path, ids, listener).map(Self::Labelled);
        }
        match phase_events::read_any(path)? {
            phase_events::Read::Labelled(recordings) => {
                let chosen = choose(path, recordings, ids, listener)?;
                Ok(Self::Labelled(EventInput::Loaded(chosen)))
            }
            phase_events::Read::Unlabelled(events) => {
                check_ids(path, events.iter().map(|(id, _)| id.as_str()), ids)?;
                let chosen: Vec<_> = events.into_iter().filter(|(id, _)| wanted(id, ids)).collect();
                for (id, event) in &chosen {
                    for warning in event.warnings() {
                        listener.note(&format!("warning: {}: event {id}: {warning}", path.display()));
                    }
                }
                Ok(Self::Unlabelled(chosen))
            }
        }
    }

    /// Number of events.
    #[must_use]
    pub const fn len(&self) -> usize {
        match self {
            Self::Labelled(input) => input.len(),
            Self::Unlabelled(events) => events.len(),
        }
    }

    /// Whether there is no event.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Loads one event.
    ///
    /// # Errors
    /// If its file cannot be used.
    pub fn load(&self, index: usize) -> Result<SeenEvent<'_>, RunError> {
        match self {
            Self::Labelled(input) => SeenEvent::of(input.load(index)?),
            Self::Unlabelled(events) => {
                let (id, observed) = &events[index];
                Ok(SeenEvent { id: Cow::Borrowed(id), observed: Cow::Borrowed(observed), recording: None })
            }
        }
    }
}

impl<'a> SeenEvent<'a> {
    /// The data that only a simulated event has.
    #[must_use]
    pub fn simulation(&self) -> Option<&SimulationRecord> {
        self.recording.as_ref()?.simulation.as_ref()
    }

    fn of(recording: Cow<'a, Recording>) -> Result<Self, RunError> {
        let observed = recording.observed().map_err(|error| RunError::Method {
            id: recording.id.clone(),
            source: phase_event::MethodError::new(error),
        })?;
        let id = Cow::Owned(recording.id.clone());
        Ok(Self { id, observed: Cow::Owned(observed), recording: Some(recording) })
    }
}

/// The track of a recording; without grips and contacts where it is not simulated.
#[must_use]
pub fn track(recording: &Recording) -> Track {
    match &recording.simulation {
        Some(simulation) => Track::of_event(&simulation.event),
        None => Track { physics: recording.scene.physics(), states: recording.trajectory.states() },
    }
}

/// The settings that an event of a file or folder was simulated with.
///
/// # Errors
/// [`RunError::SimulationSettings`].
pub(crate) fn settings(
    file: &Path,
    id: &str,
    simulation: &SimulationRecord,
) -> Result<SimulationSettings, RunError> {
    SimulationSettings::read(&simulation.settings, "settings")
        .map_err(|source| RunError::SimulationSettings { file: file.to_owned(), id: id.to_owned(), source })
}

/// Events that can be loaded one at a time.
#[derive(Debug)]
pub enum EventInput {
    /// Already read, from one file, each with its index there.
    Loaded(Vec<(usize, Recording)>),
    /// Files with one event each.
    Files(Vec<EventFile>),
}

/// An event of a folder, in a separate file.
#[derive(Debug)]
pub struct EventFile {
    /// Its index among the events of the folder, from 0.
    pub place: usize,
    /// Its id.
    pub id: String,
    /// Its file.
    pub path: PathBuf,
}

impl EventInput {
    /// Opens an event file, the folder of a dataset or of simulations, or one with event files and nothing
    /// that describes them.
    ///
    /// # Errors
    /// If there is nothing of the kind, or no event of one of the ids. Files of a folder are only read when
    /// they are loaded.
    pub fn open(path: &Path, ids: &[String], listener: &dyn Listener) -> Result<Self, RunError> {
        if !path.is_dir() {
            return read(path, ids, listener).map(Self::Loaded);
        }
        let is_dataset = path.join(MANIFEST_FILE).is_file();
        if !is_dataset && path.join(SHARD_FILE).is_file() {
            return Err(RunError::Usage(format!("{}: is a shard; merge all shards first", path.display())));
        }
        if !is_dataset && !path.join(SUMMARY_FILE).is_file() {
            return of_files(path, ids, listener);
        }
        let files: Vec<(String, RelativePath)> = if !is_dataset {
            let summary = SimulationSummary::read(&path.join(SUMMARY_FILE))?;
            summary.events.into_iter().map(|event| (event.id, event.event.path)).collect()
        } else {
            let manifest = Manifest::read(&path.join(MANIFEST_FILE))?;
            manifest.events.into_iter().map(|event| (event.id, event.event.path)).collect()
        };
        check_ids(path, files.iter().map(|(id, _)| id.as_str()), ids)?;
        let chosen = files.into_iter().enumerate().filter(|(_, (id, _))| wanted(id, ids));
        let events = chosen.map(|(place, (id, file))| EventFile { place, id, path: file.below(path) });
        Ok(Self::Files(events.collect()))
    }

    /// Number of events.
    #[must_use]
    pub const fn len(&self) -> usize {
        match self {
            Self::Loaded(recordings) => recordings.len(),
            Self::Files(files) => files.len(),
        }
    }

    /// The events that are already in memory.
    pub fn loaded(&self) -> impl Iterator<Item = &Recording> {
        let recordings = match self {
            Self::Loaded(recordings) => &recordings[..],
            Self::Files(_) => &[],
        };
        recordings.iter().map(|(_, recording)| recording)
    }

    /// Whether there is no event.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The id of an event.
    #[must_use]
    pub fn id(&self, index: usize) -> &str {
        match self {
            Self::Loaded(recordings) => &recordings[index].1.id,
            Self::Files(files) => &files[index].id,
        }
    }

    /// The index of an event among all events of its file or folder, from 0, independent of the selection.
    #[must_use]
    pub fn place(&self, index: usize) -> usize {
        match self {
            Self::Loaded(recordings) => recordings[index].0,
            Self::Files(files) => files[index].place,
        }
    }

    /// Loads one event, or lends it if it is in memory.
    ///
    /// # Errors
    /// If its file cannot be used.
    pub fn load(&self, index: usize) -> Result<Cow<'_, Recording>, RunError> {
        match self {
            Self::Loaded(recordings) => Ok(Cow::Borrowed(&recordings[index].1)),
            Self::Files(files) => {
                let EventFile { id, path, .. } = &files[index];
                let recordings = phase_events::read(path)?;
                let ids: Vec<String> = recordings.iter().map(|recording| recording.id.clone()).collect();
                let found = recordings.into_iter().find(|recording| recording.id == *id);
                let found = found.map(Cow::Owned);
                found.ok_or_else(|| RunError::unknown_id(path, id, ids.iter().map(String::as_str)))
            }
        }
    }
}

fn wanted(id: &String, ids: &[String]) -> bool {
    ids.is_empty() || ids.contains(id)
}

/// The events of a file with these ids (all, if there are none), each with its index in the file. Warnings
/// about them are printed.
///
/// # Errors
/// If the file cannot be used, or [`RunError::UnknownId`].
pub fn read(
    file: &Path,
    ids: &[String],
    listener: &dyn Listener,
) -> Result<Vec<(usize, Recording)>, RunError> {
    choose(file, phase_events::read(file)?, ids, listener)
}

fn choose(
    file: &Path,
    recordings: Vec<Recording>,
    ids: &[String],
    listener: &dyn Listener,
) -> Result<Vec<(usize, Recording)>, RunError> {
    check_ids(file, recordings.iter().map(|recording| recording.id.as_str()), ids)?;
    let chosen: Vec<_> =
        recordings.into_iter().enumerate().filter(|(_, recording)| wanted(&recording.id, ids)).collect();
    for (_, recording) in &chosen {
        for warning in recording.warnings() {
            listener.note(&format!("warning: {}: event {}: {warning}", file.display(), recording.id));
        }
    }
    Ok(chosen)
}

/// The events of all event files of a folder, in the order of their names.
fn of_files(folder: &Path, ids: &[String], listener: &dyn Listener) -> Result<EventInput, RunError> {
    let unreadable = |error| FileError { file: folder.to_owned(), problem: Problem::Unreadable(error) };
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let named = path.file_name().is_some_and(|name| !name.to_string_lossy().starts_with('.'));
        if named && path.extension().is_some_and(|extension| extension == "json") {
            files.push(path);
        }
    }
    files.sort();
    if files.is_empty() {
        return Err(RunError::NotADataset(folder.to_owned()));
    }
    let mut recordings = Vec::new();
    let mut known = BTreeSet::new();
    for file in files {
        for (_, recording) in read(&file, &[], listener)? {
            if !known.insert(recording.id.to_ascii_lowercase()) {
                let file = file.display();
                let id = &recording.id;
                return Err(RunError::Usage(format!(
                    "{file}: another file of the folder has an event {id}, too"
                )));
            }
            recordings.push(recording);
        }
    }
    check_ids(folder, recordings.iter().map(|recording| recording.id.as_str()), ids)?;
    let chosen = recordings.into_iter().enumerate().filter(|(_, recording)| wanted(&recording.id, ids));
    Ok(EventInput::Loaded(chosen.collect()))
}

fn check_ids<'a>(
    file: &Path,
    known: impl Iterator<Item = &'a str> + Clone,
    ids: &[String],
) -> Result<(), RunError> {
    match ids.iter().find(|id| known.clone().all(|other| other != *id)) {
        Some(id) => Err(RunError::unknown_id(file, id, known)),
        None => Ok(()),
    }
}

/// The events of a dataset or file, and their splits if all have one.
///
/// # Errors
/// If the events cannot be used.
pub fn items_and_splits(
    events: &Path,
    listener: &dyn Listener,
) -> Result<(Vec<Item>, Option<Vec<Split>>), RunError> {
    let manifest = events.join(MANIFEST_FILE);
    if manifest.is_file() {
        let manifest = Manifest::read(&manifest)?;
        let parts = manifest.events.iter().map(|event| event.split).collect();
        return Ok((manifest.items(), parts));
    }
    let source = EventInput::open(events, &[], listener)?;
    let item = |index: usize| {
        let recording = source.load(index)?;
        let scene = &recording.scene;
        let kind = scene.kind;
        let goals = scene.goals();
        let base = scene.layout.base();
        Ok(Item { id: recording.id.clone(), kind, goals, base })
    };
    Ok(((0..source.len()).map(item).collect::<Result<_, RunError>>()?, None))
}
