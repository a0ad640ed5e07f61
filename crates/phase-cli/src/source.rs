//! Where events come from: a file, or the folder of a dataset.

use crate::{console::remark, error::CliError};
use phase_dataset::{
    manifest::{MANIFEST_FILE, Manifest},
    phase_events,
    summary::{SUMMARY_FILE, Summary},
};
use phase_event::Recording;
use std::path::{Path, PathBuf};

/// Events that can be loaded one at a time.
#[derive(Debug)]
pub enum Source {
    /// Read already, from one file.
    Loaded(Vec<Recording>),
    /// Files with one event each.
    Files(Vec<(String, PathBuf)>),
}

impl Source {
    /// Opens an event file, or the folder of a dataset or of simulations.
    ///
    /// # Errors
    /// If there is nothing of the kind, or no event of one of the ids. Files of a folder are only looked at
    /// when they are loaded.
    pub fn open(path: &Path, ids: &[String]) -> Result<Self, CliError> {
        if !path.is_dir() {
            let chosen = read(path, ids)?;
            return Ok(Self::Loaded(chosen.into_iter().map(|(_, recording)| recording).collect()));
        }
        let is_dataset = path.join(MANIFEST_FILE).is_file();
        if !is_dataset && !path.join(SUMMARY_FILE).is_file() {
            return Err(CliError::NotADataset(path.to_owned()));
        }
        let files: Vec<(String, String)> = if !is_dataset {
            let summary = Summary::read(&path.join(SUMMARY_FILE))?;
            summary.events.into_iter().map(|event| (event.id, event.event.path)).collect()
        } else {
            let manifest = Manifest::read(&path.join(MANIFEST_FILE))?;
            manifest.events.into_iter().map(|event| (event.id, event.event.path)).collect()
        };
        check_ids(path, files.iter().map(|(id, _)| id.as_str()), ids)?;
        let wanted = |id: &String| ids.is_empty() || ids.contains(id);
        let chosen = files.into_iter().filter(|(id, _)| wanted(id));
        Ok(Self::Files(chosen.map(|(id, file)| (id, path.join(file))).collect()))
    }

    /// Number of events.
    #[must_use]
    pub const fn len(&self) -> usize {
        match self {
            Self::Loaded(recordings) => recordings.len(),
            Self::Files(files) => files.len(),
        }
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
            Self::Loaded(recordings) => &recordings[index].id,
            Self::Files(files) => &files[index].0,
        }
    }

    /// Loads one event.
    ///
    /// # Errors
    /// If its file cannot be used.
    pub fn load(&self, index: usize) -> Result<Recording, CliError> {
        match self {
            Self::Loaded(recordings) => Ok(recordings[index].clone()),
            Self::Files(files) => {
                let (id, path) = &files[index];
                let recordings = phase_events::read(path)?;
                let ids: Vec<String> = recordings.iter().map(|recording| recording.id.clone()).collect();
                let found = recordings.into_iter().find(|recording| recording.id == *id);
                found.ok_or_else(|| CliError::unknown_id(path, id, ids.iter().map(String::as_str)))
            }
        }
    }
}

/// The events of a file with these ids (all, if there are none), each with its place in the file. What is odd about
/// them is told to whoever runs the command.
///
/// # Errors
/// If the file cannot be used, or [`CliError::UnknownId`].
pub fn read(file: &Path, ids: &[String]) -> Result<Vec<(usize, Recording)>, CliError> {
    let recordings = phase_events::read(file)?;
    check_ids(file, recordings.iter().map(|recording| recording.id.as_str()), ids)?;
    let wanted = |recording: &Recording| ids.is_empty() || ids.contains(&recording.id);
    let chosen: Vec<_> =
        recordings.into_iter().enumerate().filter(|(_, recording)| wanted(recording)).collect();
    for (_, recording) in &chosen {
        for warning in recording.warnings() {
            remark(format!("warning: {}: event {}: {warning}", file.display(), recording.id));
        }
    }
    Ok(chosen)
}

fn check_ids<'a>(
    file: &Path,
    known: impl Iterator<Item = &'a str> + Clone,
    ids: &[String],
) -> Result<(), CliError> {
    match ids.iter().find(|id| known.clone().all(|other| other != *id)) {
        Some(id) => Err(CliError::unknown_id(file, id, known)),
        None => Ok(()),
    }
}
