//! Simulations compared with the recordings they started from: `summary.json`.
//!
//! A [`MeasuredPair`] is one recording and one simulation of its scene, measured; a [`EventComparison`] is
//! what the file keeps of it; a [`KindRow`] pools the pairs of one kind of event.

mod comparison;
mod quartiles;
mod rows;

pub use comparison::{AgentComparison, EventComparison, MeasuredPair, MotionSummary, RecordingSource};
pub use quartiles::Quartiles;
pub use rows::{KindRow, MotionQuartiles, tabulate};

use phase_files::{FileError, WriteError, atomic, json};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::Path;

/// The value of the field `format` of summaries.
pub const SUMMARY_FORMAT: &str = "phase-simulation/2";
/// The summary's file name. It is written last: a folder with a summary is complete.
pub const SUMMARY_FILE: &str = "summary.json";

/// The results of simulating the scenes of a file.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SimulationSummary {
    /// Always [`SUMMARY_FORMAT`].
    pub format: String,
    /// The run: program, input, seeds, settings.
    pub run: Value,
    /// One line for each kind of event, and one for all.
    pub kinds: Vec<KindRow>,
    /// The simulated events, in the order of the input; those of one scene by seed.
    pub events: Vec<EventComparison>,
}

impl SimulationSummary {
    /// Assembles the comparisons of a run.
    #[must_use]
    pub fn new(run: Value, pairs: Vec<MeasuredPair>) -> Self {
        let kinds = tabulate(&pairs);
        let events = pairs.into_iter().map(|pair| pair.comparison).collect();
        Self { format: SUMMARY_FORMAT.into(), run, kinds, events }
    }

    /// Reads a summary.
    ///
    /// # Errors
    /// If it is not JSON, of another format, or incomplete.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        json::read_format(path, SUMMARY_FORMAT, "summary")
    }

    /// Writes the summary atomically.
    ///
    /// # Errors
    /// If it cannot be written as JSON, or the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), WriteError> {
        atomic::write_json(path, self)
    }

    /// Checks that every file is present and unchanged.
    ///
    /// # Errors
    /// Names the first file that is not.
    pub fn verify(&self, folder: &Path) -> Result<(), FileError> {
        let files = self.events.iter().flat_map(|event| [Some(&event.event), event.video.as_ref()]);
        files.flatten().try_for_each(|file| file.verify(folder))
    }
}
