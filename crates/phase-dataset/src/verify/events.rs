//! Whether the file of an event is what PHASE writes for the event in it, and agrees with the manifest.

use super::video;
use crate::DatasetProblem;
use crate::{
    event_set::{PairEntry, SetEntry, set_video_path},
    form::StimulusForm,
    manifest::{EventEntry, MANIFEST_FILE, Manifest, event_path, video_path},
    parquet,
};
use phase_event::{Event, EventReadError, Recording};
use phase_files::{FileError, Problem, json};
use phase_model::json::{FieldError, shown};
use serde_json::Value;
use std::{collections::BTreeMap, path::Path};

/// The members of settings in which the events of a dataset may differ.
const LENGTHS: [&str; 2] = ["min_steps", "max_steps"];

/// Checks that an event's file holds what follows from its event and nothing else, and agrees with the
/// manifest.
pub(super) fn check(folder: &Path, manifest: &Manifest, entry: &EventEntry) -> Result<(), FileError> {
    let file = entry.event.place(folder);
    let recording = parquet::read(folder, entry)?;
    let fail = |field: &str, rule: String| {
        let problem = FieldError { field: field.into(), rule };
        FileError {
            file: file.clone(),
            problem: Problem::content(EventReadError::Field { event: Some(recording.id.clone()), problem }),
        }
    };
    let Some(simulation) = &recording.simulation else {
        return Err(fail("substeps", "is missing".into()));
    };
    let json = entry.event.clone();
    let video = entry.video.clone();
    let mut found = EventEntry::with_files(&recording.id, &simulation.event, json, video);
    found.relation = recording.relation;
    (found.variant, found.split, found.set) = (entry.variant, entry.split, entry.set.clone());
    let encode = |entry: &EventEntry| {
        serde_json::to_value(entry)
            .map_err(|error| FileError { file: file.clone(), problem: DatasetProblem::Encode(error).into() })
    };
    let found = encode(&found)?;
    let expected = encode(entry)?;
    let disagree =
        |found: &Value, said: &Value| format!("is {}, but the manifest says {}", shown(found), shown(said));
    for (key, value) in expected.as_object().into_iter().flatten() {
        let found = found.get(key).unwrap_or(&Value::Null);
        if found != value {
            return Err(fail(key, disagree(found, value)));
        }
    }
    if simulation.generator != manifest.generator {
        let found = Value::from(simulation.generator.as_str());
        let said = Value::from(manifest.generator.as_str());
        return Err(fail("generator", disagree(&found, &said)));
    }
    if without_lengths(&simulation.settings) != without_lengths(&manifest.settings) {
        return Err(fail("settings", "differs from that of the manifest".into()));
    }
    let whole = written(&recording).map_err(|error| fail("values", error.to_string()))?;
    if json::bytes(&file)? != whole.as_bytes() {
        return Err(FileError { file, problem: DatasetProblem::Form.into() });
    }
    match &entry.video {
        Some(video) => video::check(folder, video, manifest.form.frames(simulation.event.steps.len())),
        None => Ok(()),
    }
}

/// The file that PHASE writes for the event of a recording: everything else in it follows from that.
fn written(recording: &Recording) -> Result<String, phase_event::EventWriteError> {
    let Some(simulation) = recording.simulation.clone() else { return phase_event::to_json(&[]) };
    let id = recording.id.as_str();
    let generator = simulation.generator;
    phase_event::to_json(&[Recording::of_event(id, simulation.event, generator, simulation.settings)])
}

/// Checks that the files of an event and of a set have the names that belong to them, and that sets and
/// events name each other.
pub(super) fn names(folder: &Path, manifest: &Manifest) -> Vec<FileError> {
    let mut rules = Vec::new();
    for entry in &manifest.events {
        let video = entry.video.as_ref().is_none_or(|video| *video.path.as_str() == *video_path(&entry.id));
        if *entry.event.path.as_str() != *event_path(&entry.id) || !video {
            rules.push(format!("the files of the event {} have other names", entry.id));
        }
        let videos = manifest.events[0].video.is_some();
        if entry.video.is_some() != videos {
            rules.push(format!("the event {} {} a video", entry.id, if videos { "lacks" } else { "has" }));
        }
    }
    let members = members(manifest);
    for set in &manifest.sets {
        if set.video.as_ref().is_some_and(|video| *video.path.as_str() != *set_video_path(&set.id)) {
            rules.push(format!("the video of the set {} has another name", set.id));
        }
        if !members.contains_key(set.id.as_str()) {
            rules.push(format!("the set {} has no events", set.id));
        }
    }
    for set in members.keys().filter(|set| !manifest.sets.iter().any(|it| it.id == **set)) {
        rules.push(format!("there is no set {set}"));
    }
    let problem = |rule| FileError {
        file: folder.join(MANIFEST_FILE),
        problem: Problem::Shape { what: "dataset manifest", rule },
    };
    rules.into_iter().map(problem).collect()
}

/// The events of each set, in order.
pub(super) fn members(manifest: &Manifest) -> BTreeMap<&str, Vec<&EventEntry>> {
    let mut members: BTreeMap<&str, Vec<&EventEntry>> = BTreeMap::new();
    for entry in &manifest.events {
        if let Some(place) = &entry.set {
            members.entry(&place.set).or_default().push(entry);
        }
    }
    members
}

/// Checks that the events of a set part where the manifest says.
pub(super) fn pairs(
    folder: &Path,
    form: &StimulusForm,
    set: &SetEntry,
    members: &[&EventEntry],
) -> Result<(), FileError> {
    let read = |entry: &&EventEntry| parquet::read(folder, entry);
    let recordings: Vec<Recording> = members.iter().map(read).collect::<Result<_, _>>()?;
    let simulated = |recording: &Recording| recording.simulation.as_ref().map(|it| it.event.clone());
    let events: Vec<(&str, Event)> =
        recordings.iter().filter_map(|it| Some((it.id.as_str(), simulated(it)?))).collect();
    let named: Vec<(&str, &Event)> = events.iter().map(|(id, event)| (*id, event)).collect();
    if PairEntry::all(&named) != set.pairs {
        let rule = format!("field `pairs` of the set {} is not what its events show", set.id);
        let problem = Problem::Shape { what: "dataset manifest", rule };
        return Err(FileError { file: folder.join(MANIFEST_FILE), problem });
    }
    let longest = events.iter().map(|(_, event)| event.steps.len()).max().unwrap_or(0);
    set.video.as_ref().map_or(Ok(()), |video| video::check(folder, video, form.frames(longest)))
}

/// Settings without the members in which events may differ.
fn without_lengths(settings: &Value) -> Value {
    let mut settings = settings.clone();
    if let Some(members) = settings.as_object_mut() {
        members.retain(|key, _| !LENGTHS.contains(&key.as_str()));
    }
    settings
}
