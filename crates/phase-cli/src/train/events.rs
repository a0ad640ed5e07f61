//! The events to learn from, to validate on and to test with.

use super::options::Options;
use crate::error::train::TrainError;
use phase_baselines::training::Source;
use phase_dataset::{
    checksum::{hexadecimal, sha256},
    manifest::{EventEntry, MANIFEST_FILE, Manifest},
    phase_events,
    splits::Split,
};
use phase_event::Recording;
use std::path::{Path, PathBuf};

/// What the options choose.
#[derive(Debug)]
pub(super) struct Events {
    data: Dataset,
    /// Where validation and test events are from, if not from there.
    validation: Option<Dataset>,
    /// How many training events to learn from, of as many as there are.
    count: usize,
}

impl Events {
    /// Opens the datasets.
    ///
    /// # Errors
    /// If one is none, its manifest cannot be used, or there are fewer training events than are asked for.
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

    /// Checks that there are events to learn from and to validate on.
    ///
    /// # Errors
    /// [`TrainError::NoEvents`].
    pub(super) fn check(&self) -> Result<(), TrainError> {
        [Split::Train, Split::Validation].into_iter().try_for_each(|split| self.of(split).map(|_| ()))
    }

    /// Reads the events of a split, in the manifest's order, each when it is asked for.
    ///
    /// # Errors
    /// If there are none; each event's own if its file cannot be used.
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

    /// What a record says of the events of a split.
    pub(super) fn source(&self, split: Split) -> Source {
        let (dataset, count) = self.chosen(split);
        let events = dataset.entries(split).take(count).count();
        Source { folder: dataset.name(), sha256: hexadecimal(&sha256(dataset.id().as_bytes())), events }
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

    /// Something that stands for all of it: every event's checksum is in it.
    fn id(&self) -> String {
        let entries = self.manifest.events.iter();
        entries.map(|entry| format!("{} {:?} {}\n", entry.id, entry.split, entry.event.sha256)).collect()
    }

    /// The folder's own name, whatever way leads to it.
    fn name(&self) -> String {
        let folder = self.folder.canonicalize().unwrap_or_else(|_| self.folder.clone());
        folder.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }
}
