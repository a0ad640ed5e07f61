//! The training, validation and test events.

use super::options::Options;
use crate::error::train::TrainError;
use phase_baselines::training::DataSource;
use phase_dataset::{
    checksum::{hexadecimal, sha256},
    manifest::{EventEntry, MANIFEST_FILE, Manifest},
    phase_events,
    splits::Split,
};
use phase_event::Recording;
use std::path::{Path, PathBuf};

/// The datasets selected by the options.
#[derive(Debug)]
pub(super) struct Events {
    data: Dataset,
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
    pub(super) fn open(options: &Options) -> Result<Self, TrainError> {
        let data = Dataset::open(&options.data)?;
        let validation = options.validation.as_deref().map(Dataset::open).transpose()?;
        let found = data.entries(Split::Train).count();
        let count = options.events.unwrap_or(found);
        if count > found {
            return Err(TrainError::TooFewEvents { folder: data.folder, asked: count, found });
        }
        Ok(Self { data, validation, count })
    }

    /// Checks that there are training and validation events.
    ///
    /// # Errors
    /// [`TrainError::NoEvents`].
    pub(super) fn check(&self) -> Result<(), TrainError> {
        [Split::Train, Split::Validation].into_iter().try_for_each(|split| self.of(split).map(|_| ()))
    }

    /// Reads the events of a split lazily, in the manifest's order.
    ///
    /// # Errors
    /// If there are none; for each event, if its file cannot be used.
    pub(super) fn of(
        &self,
        split: Split,
    ) -> Result<impl Iterator<Item = Result<Recording, TrainError>>, TrainError> {
        let (dataset, count) = self.chosen(split);
        if dataset.entries(split).next().is_none() {
            return Err(TrainError::NoEvents { folder: dataset.folder.clone(), split: split.name() });
        }
        Ok(dataset.entries(split).take(count).map(|entry| {
            let file = dataset.folder.join(&entry.event.path);
            let found = phase_events::read(&file)?.into_iter().find(|recording| recording.id == entry.id);
            found.ok_or_else(|| TrainError::UnknownId { file, id: entry.id.clone() })
        }))
    }

    /// The record's description of the events of a split.
    pub(super) fn source(&self, split: Split) -> DataSource {
        let (dataset, count) = self.chosen(split);
        let events = dataset.entries(split).take(count).count();
        DataSource { folder: dataset.name(), sha256: hexadecimal(&sha256(dataset.id().as_bytes())), events }
    }

    fn chosen(&self, split: Split) -> (&Dataset, usize) {
        match split {
            Split::Train => (&self.data, self.count),
            _ => (self.validation.as_ref().unwrap_or(&self.data), usize::MAX),
        }
    }
}

/// A finished dataset.
#[derive(Debug)]
struct Dataset {
    folder: PathBuf,
    manifest: Manifest,
}

impl Dataset {
    fn open(folder: &Path) -> Result<Self, TrainError> {
        let path = folder.join(MANIFEST_FILE);
        if !path.is_file() {
            return Err(TrainError::NotADataset(folder.to_owned()));
        }
        Ok(Self { folder: folder.to_owned(), manifest: Manifest::read(&path)? })
    }

    fn entries(&self, split: Split) -> impl Iterator<Item = &EventEntry> {
        self.manifest.events.iter().filter(move |entry| entry.split == Some(split))
    }

    /// A digest of the dataset, over the checksums of all events.
    fn id(&self) -> String {
        let entries = self.manifest.events.iter();
        entries.map(|entry| format!("{} {:?} {}\n", entry.id, entry.split, entry.event.sha256)).collect()
    }

    /// The folder's own name, independent of the path to it.
    fn name(&self) -> String {
        let folder = self.folder.canonicalize().unwrap_or_else(|_| self.folder.clone());
        folder.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }
}
