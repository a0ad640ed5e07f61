//! A dataset without its events: how it was generated, how many events of each kind it has, and its other
//! files.

use crate::{
    acceptance::Acceptance,
    form::StimulusForm,
    manifest::{EventEntry, Manifest},
    shard::DatasetDescription,
    splits::Split,
};
use phase_evidence::Manner;
use phase_files::checksum::FileEntry;
use phase_model::{EventKind, Level};
use serde_json::Value;
use std::collections::BTreeMap;

/// Everything about a dataset whose size does not depend on its number of events, apart from one file for
/// every few thousand of them.
#[derive(Clone, PartialEq, Debug)]
pub struct Overview {
    /// Name and version of the program that generated it.
    pub generator: String,
    /// Name of the preset it was generated from.
    pub preset: String,
    /// The random seed of the dataset.
    pub seed: u64,
    /// The date of publication, if it was given: YYYY-MM-DD.
    pub date_published: Option<String>,
    /// Settings of simulation and agents.
    pub settings: Value,
    /// Length and look of the events.
    pub form: StimulusForm,
    /// Scenes tried and reasons why most were rejected, by variant; empty where nothing was selected.
    pub selection: Vec<Acceptance>,
    /// Number of events.
    pub events: usize,
    /// Number of events of each kind that occurs.
    pub kinds: BTreeMap<EventKind, usize>,
    /// Number of agents that do not know the other's goal, by level of reasoning.
    pub levels: BTreeMap<Level, usize>,
    /// Number of events that show each manner of helping, hindering or meeting.
    pub manners: BTreeMap<Manner, usize>,
    /// Number of events in each part that is not empty.
    pub splits: BTreeMap<Split, usize>,
    /// Number of sets of events that differ in one social variable.
    pub sets: usize,
    /// Whether there are videos.
    pub videos: bool,
    /// The files that do not belong to a single event or set.
    pub files: Vec<FileEntry>,
}

impl Overview {
    /// A dataset of which no event has been counted yet.
    #[must_use]
    pub fn new(whole: &DatasetDescription) -> Self {
        Self {
            generator: whole.generator.clone(),
            preset: whole.preset.clone(),
            seed: whole.seed,
            date_published: whole.date_published.clone(),
            settings: whole.settings.clone(),
            form: whole.form.clone(),
            selection: Vec::new(),
            events: 0,
            kinds: BTreeMap::new(),
            levels: BTreeMap::new(),
            manners: BTreeMap::new(),
            splits: BTreeMap::new(),
            sets: 0,
            videos: false,
            files: Vec::new(),
        }
    }

    /// A dataset whose manifest is in memory.
    #[must_use]
    pub fn of(manifest: &Manifest) -> Self {
        let mut overview = Self {
            generator: manifest.generator.clone(),
            preset: manifest.preset.clone(),
            seed: manifest.seed,
            date_published: manifest.date_published.clone(),
            settings: manifest.settings.clone(),
            form: manifest.form.clone(),
            selection: manifest.selection.clone(),
            events: 0,
            kinds: BTreeMap::new(),
            levels: BTreeMap::new(),
            manners: BTreeMap::new(),
            splits: BTreeMap::new(),
            sets: manifest.sets.len(),
            videos: false,
            files: manifest.files.clone(),
        };
        manifest.events.iter().for_each(|entry| overview.count(entry));
        overview
    }

    /// Counts an event.
    pub fn count(&mut self, entry: &EventEntry) {
        self.events += 1;
        *self.kinds.entry(entry.kind).or_default() += 1;
        for level in entry.agents.iter().filter_map(|agent| agent.level) {
            *self.levels.entry(level).or_default() += 1;
        }
        for &manner in &entry.manners {
            *self.manners.entry(manner).or_default() += 1;
        }
        *self.splits.entry(entry.split()).or_default() += 1;
        self.videos |= entry.video.is_some();
    }
}
