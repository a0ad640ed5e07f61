//! The events of a dataset, by their split.

use crate::error::TrainError;
use phase_dataset::{
    manifest::{MANIFEST_FILE, Manifest},
    phase_events::{self, Recording},
    splits::Split,
};
use std::path::{Path, PathBuf};

/// A finished dataset.
#[derive(Debug)]
pub(crate) struct Dataset {
    folder: PathBuf,
    manifest: Manifest,
}

impl Dataset {
    /// Opens the folder of a dataset.
    ///
    /// # Errors
    /// If it is none, or its manifest cannot be used.
    pub(crate) fn open(folder: &Path) -> Result<Self, TrainError> {
        let path = folder.join(MANIFEST_FILE);
        if !path.is_file() {
            return Err(TrainError::NotADataset(folder.to_owned()));
        }
        Ok(Self { folder: folder.to_owned(), manifest: Manifest::read(&path)? })
    }

    /// Something that stands for all of it: every event's checksum is in it.
    pub(crate) fn id(&self) -> String {
        let entries = self.manifest.events.iter();
        entries.map(|entry| format!("{} {:?} {}\n", entry.id, entry.split, entry.event.sha256)).collect()
    }

    /// Reads the events of a split, in the manifest's order, each when it is asked for.
    ///
    /// # Errors
    /// If there are none; each event's own if its file cannot be used.
    pub(crate) fn events(
        &self,
        split: Split,
    ) -> Result<impl Iterator<Item = Result<Recording, TrainError>>, TrainError> {
        let entries = self.manifest.events.iter().filter(move |entry| entry.split == Some(split));
        if entries.clone().next().is_none() {
            return Err(TrainError::NoEvents { folder: self.folder.clone(), split: split.name() });
        }
        Ok(entries.map(|entry| {
            let file = self.folder.join(&entry.event.path);
            let found = phase_events::read(&file)?.into_iter().find(|recording| recording.id == entry.id);
            found.ok_or_else(|| TrainError::UnknownId { file, id: entry.id.clone() })
        }))
    }
}
