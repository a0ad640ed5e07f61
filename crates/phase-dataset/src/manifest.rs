//! `manifest.json`: what a dataset contains, how it was generated, and the checksum of every file.

use crate::{
    acceptance::Acceptance,
    event_set::{SetEntry, SetPlace},
    form::StimulusForm,
    ids,
    splits::{Item, Split},
};
use phase_event::Event;
use phase_evidence::{GoalOutcome, Manner, Track};
use phase_files::{
    FileError, WriteError, atomic,
    checksum::{FileEntry, sha256_hex},
    json,
};
use phase_model::{AGENT_COUNT, EventKind, Goal, Level, Relation};
use phase_sampler::Variant;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::Path;

/// The value of the field `format` of manifests.
pub const DATASET_FORMAT: &str = "phase-dataset/1";
/// The manifest's file name. It is written last: a folder with a manifest is complete.
pub const MANIFEST_FILE: &str = "manifest.json";
/// The file with the manifest's checksum, in the form of `sha256sum`. It is written before the manifest.
pub const DIGEST_FILE: &str = "manifest.sha256";
/// Detached signatures of the manifest, by `ssh-keygen -Y sign` and by minisign. They are not part of the
/// dataset, but may lie in its folder.
pub(crate) const SIGNATURE_FILES: [&str; 2] = ["manifest.json.sig", "manifest.json.minisig"];
/// File name of the dataset card.
pub const CARD_FILE: &str = "README.md";
/// File name of the gallery, the page that shows every video; a dataset without videos has none.
pub const PAGE_FILE: &str = "index.html";

/// A whole dataset, as `manifest.json` describes it.
///
/// It lists every event with its labels, seed and files, and every other file, each with size and SHA-256.
/// The checksum of the manifest therefore stands for the dataset. Files that are read are not trusted:
/// [`Self::read`] checks their form, [`Self::verify`] their contents.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Always [`DATASET_FORMAT`].
    pub format: String,
    /// Name and version of the program that generated it.
    pub generator: String,
    /// Name of the preset it was generated from.
    pub preset: String,
    /// The random seed of the dataset.
    pub seed: u64,
    /// The date of publication, if it was given: YYYY-MM-DD.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub date_published: Option<String>,
    /// Settings of simulation and agents.
    pub settings: Value,
    /// Length and look of the events, where they are not the usual ones.
    #[serde(default, skip_serializing_if = "StimulusForm::is_default")]
    pub form: StimulusForm,
    /// Scenes tried and reasons why most were rejected, by variant; empty where nothing was selected.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub selection: Vec<Acceptance>,
    /// The events, in order.
    pub events: Vec<EventEntry>,
    /// The sets that they form, if they differ in one social variable.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sets: Vec<SetEntry>,
    /// The files that do not belong to a single event or set.
    pub files: Vec<FileEntry>,
}

/// One event of a dataset: its labels, the outcome of its goals, and its files.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EventEntry {
    /// Name.
    #[serde(deserialize_with = "ids::deserialize")]
    pub id: String,
    /// The intended kind of event.
    pub kind: EventKind,
    /// The variant of its kind; unknown for events of other programs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub variant: Option<Variant>,
    /// The set that it belongs to, if it belongs to one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub set: Option<SetPlace>,
    /// The part of the dataset it belongs to, if the dataset is divided.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub split: Option<Split>,
    /// The relation that follows from goals and attitudes.
    pub relation: Relation,
    /// The event's own seed.
    pub seed: u64,
    /// The positions of the walls.
    pub layout: LayoutEntry,
    /// The agents.
    pub agents: [AgentEntry; AGENT_COUNT],
    /// Size levels of the objects.
    pub object_size_levels: Vec<u8>,
    /// Length (steps of 0.25 s of video).
    pub steps: usize,
    /// In what manner one helps or hinders the other, or the two meet, by what is seen.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub manners: Vec<Manner>,
    /// The event with everything known about it.
    pub event: FileEntry,
    /// The video, unless the dataset was generated without.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub video: Option<FileEntry>,
}

/// A layout by its base and reflection.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LayoutEntry {
    /// 0 to 21.
    pub base: u8,
    /// 0 to 3, or none.
    pub flip: Option<u8>,
}

/// One agent of an event and the outcome of its goal.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AgentEntry {
    /// 0 to 3.
    pub size_level: u8,
    /// 0 to 3.
    pub strength_level: u8,
    /// The goal.
    pub goal: Goal,
    /// Social utility weight: −1, 0 or 1.
    pub alpha: i8,
    /// Level of reasoning, if it does not know the other's goal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub level: Option<Level>,
    /// Whether the goal was reached; see [`GoalOutcome`].
    pub reached: bool,
    /// Steps until it was reached, for positive goals.
    pub steps_to_goal: Option<usize>,
}

impl EventEntry {
    /// Describes an event whose files, its JSON and perhaps its video, are already in a dataset's folder.
    ///
    /// # Errors
    /// If a file cannot be read.
    pub fn of(folder: &Path, id: &str, event: &Event, has_video: bool) -> Result<Self, FileError> {
        let video = has_video.then(|| FileEntry::of(folder, video_path(id))).transpose()?;
        Ok(Self::with_files(id, event, FileEntry::of(folder, event_path(id))?, video))
    }

    /// Describes an event whose files are already described.
    #[must_use]
    pub fn with_files(id: &str, event: &Event, json: FileEntry, video: Option<FileEntry>) -> Self {
        let scene = &event.scene;
        let track = Track::of_event(event);
        let agent = |k: usize| {
            let spec = &scene.agents[k];
            let outcome = GoalOutcome::of(&track, spec.goal);
            AgentEntry {
                size_level: spec.size.level(),
                strength_level: spec.strength.level(),
                goal: spec.goal,
                alpha: spec.attitude.alpha(),
                level: spec.awareness.knows.level(),
                reached: outcome.reached,
                steps_to_goal: outcome.steps,
            }
        };
        Self {
            id: id.into(),
            kind: scene.kind,
            variant: None,
            set: None,
            split: None,
            relation: scene.relation(),
            seed: event.seed,
            layout: LayoutEntry { base: scene.layout.base(), flip: scene.layout.flip().map(u8::from) },
            agents: core::array::from_fn(agent),
            object_size_levels: scene.objects.iter().map(|object| object.size.level()).collect(),
            steps: event.steps.len(),
            manners: Manner::of_event(event, &track),
            event: json,
            video,
        }
    }

    /// The event's files.
    pub fn files(&self) -> impl Iterator<Item = &FileEntry> {
        core::iter::once(&self.event).chain(&self.video)
    }

    /// The part of the dataset it is in; a dataset that is not divided is all for training.
    #[must_use]
    pub fn split(&self) -> Split {
        self.split.unwrap_or(Split::Train)
    }
}

/// The text of [`DIGEST_FILE`].
#[must_use]
pub(crate) fn digest_line(sha256: &str) -> String {
    format!("{sha256}  {MANIFEST_FILE}\n")
}

/// Writes [`DIGEST_FILE`] atomically.
///
/// # Errors
/// If it cannot be written.
pub fn write_digest(folder: &Path, sha256: &str) -> Result<(), WriteError> {
    atomic::write(&folder.join(DIGEST_FILE), digest_line(sha256).as_bytes())
}

/// Path of an event's JSON, relative to the dataset's folder.
#[must_use]
pub fn event_path(id: &str) -> String {
    format!("events/{id}.json")
}

/// Path of an event's video, relative to the dataset's folder.
#[must_use]
pub fn video_path(id: &str) -> String {
    format!("videos/{id}.mp4")
}

impl Manifest {
    /// Reads a manifest.
    ///
    /// # Errors
    /// If it is not JSON, of another format, or incomplete.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        json::read_format(path, DATASET_FORMAT, "dataset manifest")
    }

    /// The text of its file.
    ///
    /// # Errors
    /// If it cannot be written as JSON.
    pub fn to_text(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self).map(|text| text + "\n")
    }

    /// Writes the manifest into a folder, each file atomically: first [`DIGEST_FILE`], then
    /// [`MANIFEST_FILE`].
    ///
    /// # Errors
    /// If it cannot be written as JSON, or a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), WriteError> {
        let path = folder.join(MANIFEST_FILE);
        let text = self.to_text().map_err(|error| WriteError::json(&path, error))?;
        write_digest(folder, &sha256_hex(text.as_bytes()))?;
        atomic::write(&path, text.as_bytes())
    }

    /// The properties of each event that determine which splits it may belong to, in the events' order.
    #[must_use]
    pub fn items(&self) -> Vec<Item> {
        let item = |event: &EventEntry| Item {
            id: event.id.clone(),
            kind: event.kind,
            goals: event.agents.map(|agent| agent.goal),
            base: event.layout.base,
        };
        self.events.iter().map(item).collect()
    }

    /// Checks that every file is present and unchanged.
    ///
    /// # Errors
    /// Names the first file that is not.
    pub fn verify(&self, folder: &Path) -> Result<(), FileError> {
        self.all_files().try_for_each(|file| file.verify(folder))
    }

    /// Every file of the dataset except the manifest.
    pub fn all_files(&self) -> impl Iterator<Item = &FileEntry> {
        let of_sets = self.sets.iter().filter_map(|set| set.video.as_ref());
        self.events.iter().flat_map(EventEntry::files).chain(of_sets).chain(&self.files)
    }
}
