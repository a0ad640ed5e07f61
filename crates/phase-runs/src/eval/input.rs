//! The events that a method is evaluated on.

use super::Evaluation;
use crate::{
    error::RunError,
    listener::Listener,
    source::{EventInput, labels_and_rows},
};
use phase_dataset::{
    manifest::{MANIFEST_FILE, Manifest},
    splits::Split,
};
use phase_event::Recording;
use phase_files::{checksum::sha256_hex, run};
use phase_model::AGENT_COUNT;
use phase_sampler::Variant;
use std::{
    borrow::Cow,
    collections::BTreeSet,
    path::{Path, PathBuf},
};

/// The events of a run, loaded one at a time.
#[derive(Debug)]
pub(crate) struct Input {
    /// Their name in the name of a folder.
    pub name: String,
    /// Their name in a report.
    pub description: String,
    /// Their file or folder.
    pub path: PathBuf,
    /// Digest of their contents.
    pub sha256: String,
    /// The events.
    pub events: Vec<Event>,
    source: EventInput,
}

/// One event, before it is loaded.
#[derive(Debug)]
pub(crate) struct Event {
    /// Its name.
    pub id: String,
    /// Its length (steps).
    pub steps: usize,
    /// Its numbers of agents and objects.
    pub entities: usize,
    /// Whether it was simulated, so that the thoughts of its agents are known.
    pub simulated: bool,
    /// The set that it belongs to, if its dataset consists of sets.
    pub set: Option<String>,
    /// Whether its base layout is in the training or validation events too, if the dataset is divided
    /// and has such events.
    pub layout_seen: Option<bool>,
    /// Whether its type of interaction is in the training or validation events too, if the dataset is divided
    /// and has such events.
    pub interaction_seen: Option<bool>,
    index: usize,
    contents: String,
}

impl Input {
    /// Opens a file or dataset and applies the selection.
    pub(crate) fn open(evaluation: &Evaluation, listener: &dyn Listener) -> Result<Self, RunError> {
        let path = &evaluation.events;
        let source = EventInput::open(path, &[], listener)?;
        let manifest = path.join(MANIFEST_FILE);
        let mut events = if manifest.is_file() {
            of_manifest(&Manifest::read(&manifest)?, evaluation.split)
        } else if evaluation.split.is_some() {
            let rule = "is not a dataset with a manifest: --split needs a dataset";
            return Err(RunError::Usage(format!("{}: {rule}", path.display())));
        } else {
            (0..source.len())
                .map(|index| of_recording(index, source.load(index)?.as_ref()))
                .collect::<Result<_, _>>()?
        };
        if events.is_empty() {
            let rule = evaluation.split.map_or_else(
                || "has no events".to_owned(),
                |split| format!("has no {} events; datasets of the preset phase-500 have", split.name()),
            );
            return Err(RunError::Usage(format!("{}: {rule}", path.display())));
        }
        events.truncate(evaluation.limit.unwrap_or(usize::MAX));
        for event in &mut events {
            if let Some(name) = evaluation.names.get(&event.id) {
                event.id.clone_from(name);
            }
        }
        let contents: String =
            events.iter().map(|event| format!("{} {}\n", event.id, event.contents)).collect();
        let (name, description) = names(path, evaluation.split);
        Ok(Self {
            name,
            description,
            path: path.clone(),
            sha256: sha256_hex(contents.as_bytes()),
            events,
            source,
        })
    }

    /// Loads one of the events.
    pub(crate) fn load(&self, event: &Event) -> Result<Cow<'_, Recording>, RunError> {
        self.source.load(event.index)
    }
}

fn of_manifest(manifest: &Manifest, split: Option<Split>) -> Vec<Event> {
    let learnt = || manifest.events.iter().filter(|entry| entry.split() != Split::Test);
    // A dataset of test events alone has nothing to learn from.
    let divided = manifest.events.iter().any(|entry| entry.split.is_some()) && learnt().next().is_some();
    let layouts: BTreeSet<u8> = learnt().map(|entry| entry.layout.base).collect();
    let variants: BTreeSet<Variant> = learnt().filter_map(|entry| entry.variant).collect();
    let entries = manifest.events.iter().enumerate();
    let chosen = entries.filter(|(_, entry)| split.is_none_or(|split| entry.split() == split));
    let event = chosen.map(|(index, entry)| Event {
        id: entry.id.clone(),
        steps: entry.steps,
        entities: AGENT_COUNT + entry.object_size_levels.len(),
        simulated: true,
        set: entry.set.as_ref().map(|place| place.set.clone()),
        layout_seen: divided.then(|| layouts.contains(&entry.layout.base)),
        interaction_seen: entry.variant.filter(|_| divided).map(|variant| variants.contains(&variant)),
        index,
        contents: entry.event.sha256.clone(),
    });
    event.collect()
}

/// An event of a file; its digest covers labels and rows, independent of the layout of the file.
fn of_recording(index: usize, recording: &Recording) -> Result<Event, RunError> {
    let scene = &recording.scene;
    let rows = &recording.trajectory;
    Ok(Event {
        id: recording.id.clone(),
        steps: rows.steps(),
        entities: AGENT_COUNT + scene.objects.len(),
        simulated: recording.simulation.is_some(),
        set: None,
        layout_seen: None,
        interaction_seen: None,
        index,
        contents: run::digest(&labels_and_rows(recording)?),
    })
}

/// The name of the events in the name of a folder, and in a report.
fn names(path: &Path, split: Option<Split>) -> (String, String) {
    // A folder may be given as `.` or end in `..`.
    let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let text = |name: Option<&std::ffi::OsStr>| name.unwrap_or_default().to_string_lossy().into_owned();
    let (stem, file) = if path.is_dir() {
        (text(whole.file_name()), text(whole.file_name()))
    } else {
        (text(whole.file_stem()), text(whole.file_name()))
    };
    match split {
        Some(split) => (format!("{stem}-{}", split.name()), format!("{file}, {} events", split.name())),
        None => (stem, file),
    }
}
