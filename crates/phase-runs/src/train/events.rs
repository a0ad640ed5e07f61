//! The training, validation and test events.

use super::Training;
use crate::error::train::TrainError;
use phase_baselines::training::DataSource;
use phase_dataset::{
    manifest::{EventEntry, MANIFEST_FILE, Manifest},
    phase_events,
    splits::Split,
    summary::{EventComparison, SUMMARY_FILE, SimulationSummary},
};
use phase_event::Recording;
use phase_files::checksum::sha256_hex;
use phase_model::path::RelativePath;
use std::path::{Path, PathBuf};

/// The datasets of a training.
#[derive(Debug)]
pub(super) struct Events {
    data: Dataset,
    /// Further training events.
    more: Vec<Dataset>,
    /// The source of validation and test events, if it is another dataset.
    validation: Option<Dataset>,
    /// Number of training events to use, and the number available.
    count: usize,
}

impl Events {
    /// Opens the datasets.
    ///
    /// # Errors
    ///
    /// If a folder is not a dataset, its manifest cannot be used, or there are fewer training events than
    /// requested.
    pub(super) fn open(training: &Training) -> Result<Self, TrainError> {
        let data = Dataset::open(&training.data)?;
        let validation = training.validation.as_deref().map(Dataset::open).transpose()?;
        let found = data.entries(Split::Train).count();
        let count = training.events.unwrap_or(found);
        if count > found {
            return Err(TrainError::TooFewEvents { folder: data.folder, asked: count, found });
        }
        let more = training.more.iter().map(|folder| Dataset::open_more(folder)).collect::<Result<_, _>>()?;
        Ok(Self { data, more, validation, count })
    }

    /// Checks that there are training and validation events, and training events in each further folder.
    pub(super) fn check(&self) -> Result<(), TrainError> {
        [Split::Train, Split::Validation].into_iter().try_for_each(|split| self.of(split).map(|_| ()))?;
        match self.more.iter().find(|dataset| dataset.entries(Split::Train).next().is_none()) {
            Some(dataset) => {
                Err(TrainError::NoEvents { folder: dataset.folder.clone(), split: Split::Train.name() })
            }
            None => Ok(()),
        }
    }

    /// Reads the events of a split lazily, in the manifest's order.
    pub(super) fn of(
        &self,
        split: Split,
    ) -> Result<impl Iterator<Item = Result<Recording, TrainError>>, TrainError> {
        let (dataset, count) = self.chosen(split);
        if dataset.entries(split).next().is_none() {
            return Err(TrainError::NoEvents { folder: dataset.folder.clone(), split: split.name() });
        }
        let more = self.more.iter().filter(move |_| split == Split::Train);
        let more = more.flat_map(move |dataset| dataset.entries(split).map(move |entry| (dataset, entry)));
        let all = dataset.entries(split).take(count).map(move |entry| (dataset, entry)).chain(more);
        Ok(all.map(|(dataset, entry)| {
            let file = entry.path.below(&dataset.folder);
            let found = phase_events::read(&file)?.into_iter().find(|recording| recording.id == entry.id);
            found.ok_or_else(|| TrainError::UnknownId { file, id: entry.id.clone() })
        }))
    }

    /// The record's description of further training events.
    pub(super) fn more_sources(&self) -> Vec<DataSource> {
        let source = |dataset: &Dataset| DataSource {
            folder: dataset.name(),
            sha256: dataset.sha256(),
            events: dataset.entries(Split::Train).count(),
        };
        self.more.iter().map(source).collect()
    }

    /// The record's description of the events of a split.
    pub(super) fn source(&self, split: Split) -> DataSource {
        let (dataset, count) = self.chosen(split);
        let events = dataset.entries(split).take(count).count();
        DataSource { folder: dataset.name(), sha256: dataset.sha256(), events }
    }

    fn chosen(&self, split: Split) -> (&Dataset, usize) {
        match split {
            Split::Train => (&self.data, self.count),
            _ => (self.validation.as_ref().unwrap_or(&self.data), usize::MAX),
        }
    }
}

/// A finished dataset, or the results of simulations.
#[derive(Debug)]
struct Dataset {
    folder: PathBuf,
    entries: Vec<Entry>,
}

/// One event of a folder.
#[derive(Debug)]
struct Entry {
    id: String,
    split: Option<Split>,
    path: RelativePath,
    sha256: String,
}

impl Dataset {
    fn open(folder: &Path) -> Result<Self, TrainError> {
        let path = folder.join(MANIFEST_FILE);
        if !path.is_file() {
            return Err(TrainError::NotADataset(folder.to_owned()));
        }
        let events = Manifest::read(&path)?.events.into_iter();
        let entry = |event: EventEntry| Entry {
            id: event.id,
            split: event.split,
            path: event.event.path,
            sha256: event.event.sha256,
        };
        Ok(Self { folder: folder.to_owned(), entries: events.map(entry).collect() })
    }

    /// A dataset, or the results of simulations, all of which are for training.
    fn open_more(folder: &Path) -> Result<Self, TrainError> {
        let path = folder.join(SUMMARY_FILE);
        if folder.join(MANIFEST_FILE).is_file() || !path.is_file() {
            return Self::open(folder);
        }
        let events = SimulationSummary::read(&path)?.events.into_iter();
        let entry = |event: EventComparison| Entry {
            id: event.id,
            split: Some(Split::Train),
            path: event.event.path,
            sha256: event.event.sha256,
        };
        Ok(Self { folder: folder.to_owned(), entries: events.map(entry).collect() })
    }

    fn entries(&self, split: Split) -> impl Iterator<Item = &Entry> {
        self.entries.iter().filter(move |entry| entry.split == Some(split))
    }

    /// Digest of the dataset, over a line for each event: its id, its split and the checksum of its file.
    fn sha256(&self) -> String {
        let line = |entry: &Entry| format!("{} {} {}\n", entry.id, split_word(entry.split), entry.sha256);
        sha256_hex(self.entries.iter().map(line).collect::<String>().as_bytes())
    }

    /// The folder's own name, independent of the path to it.
    fn name(&self) -> String {
        let folder = self.folder.canonicalize().unwrap_or_else(|_| self.folder.clone());
        folder.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }
}

/// A split in the digest of a dataset. These words are part of the digests in the training records of the
/// bundled weights.
const fn split_word(split: Option<Split>) -> &'static str {
    match split {
        Some(Split::Train) => "Some(Train)",
        Some(Split::Validation) => "Some(Validation)",
        Some(Split::Test) => "Some(Test)",
        None => "None",
    }
}
