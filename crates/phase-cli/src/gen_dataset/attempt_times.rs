//! What the attempts at a dataset cost: `phase-attempt-times/1`, for `cargo xtask check-schedule`.
//!
//! CPU times differ from run to run, so they are in a file of their own, outside of the dataset.

use super::schedule::Part;
use crate::error::CliError;
use phase_files::{FileError, Problem, WriteError, atomic::AtomicFile, json};
use phase_sampler::Variant;
use serde::{Deserialize, Serialize};
use std::{
    io::Write,
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

/// The value of the field `format` of the file's first line.
pub const FORMAT: &str = "phase-attempt-times/1";

/// A line of the file.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Line {
    /// The first line.
    Format(String),
    /// An attempt that counts: one that was refused, or the accepted one.
    Attempt(AttemptTimes),
    /// Writing the files that describe the whole: CPU time of the thread that did so (s). The last line.
    Completing(f64),
}

/// What an attempt cost.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AttemptTimes {
    /// Number of the slot in the dataset.
    pub slot: usize,
    /// Number of the attempt, from 0.
    pub attempt: usize,
    /// The variants of its events.
    pub variants: Vec<Variant>,
    /// Events that passed the tests on themselves.
    pub passed: usize,
    /// Whether it was accepted.
    pub accepted: bool,
    /// CPU time of drawing its scenes (s).
    pub scenes: f64,
    /// The simulations that its judgement is based on, in the order in which one thread runs them.
    pub parts: Vec<PartTime>,
    /// CPU time of writing its files, if it was accepted (s).
    pub files: f64,
}

/// What a simulation cost.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PartTime {
    /// Which simulation.
    pub part: Part,
    /// CPU time (s).
    pub cpu_seconds: f64,
}

impl AttemptTimes {
    /// CPU time of everything (s).
    #[must_use]
    pub fn cpu_seconds(&self) -> f64 {
        self.scenes + self.parts.iter().map(|part| part.cpu_seconds).sum::<f64>() + self.files
    }
}

/// Reads a file, without the line that names its format.
///
/// # Errors
/// If it cannot be read, or a line is something else.
pub fn read(path: &Path) -> Result<Vec<Line>, FileError> {
    let bytes = json::bytes(path)?;
    let failed = |problem| FileError { file: path.to_owned(), problem };
    let what = "list of attempt times";
    let lines = bytes.split(|byte| *byte == b'\n').filter(|line| !line.is_empty());
    let lines = lines.map(|line| {
        serde_json::from_slice(line).map_err(|source| failed(Problem::Incomplete { what, source }))
    });
    let lines = lines.collect::<Result<Vec<Line>, FileError>>()?;
    match lines.split_first() {
        Some((Line::Format(format), rest)) if format == FORMAT => Ok(rest.to_vec()),
        _ => Err(failed(Problem::Shape {
            what,
            rule: format!("the first line must name the format {FORMAT}"),
        })),
    }
}

/// Writes a file, line by line as attempts are decided; it appears when it is finished.
#[derive(Debug)]
pub(super) struct Writer {
    path: PathBuf,
    file: Mutex<AtomicFile>,
}

impl Writer {
    pub(super) fn new(path: &Path) -> Result<Self, CliError> {
        let new = Self {
            path: path.to_owned(),
            file: Mutex::new(AtomicFile::create(path).map_err(CliError::Output)?),
        };
        new.add(&Line::Format(FORMAT.into()))?;
        Ok(new)
    }

    pub(super) fn add(&self, line: &Line) -> Result<(), CliError> {
        let mut text = serde_json::to_vec(line).map_err(|error| WriteError::json(&self.path, error))?;
        text.push(b'\n');
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.write_all(&text).map_err(|source| CliError::Output(file.failed(source)))
    }

    pub(super) fn finish(self) -> Result<(), CliError> {
        self.file.into_inner().unwrap_or_else(PoisonError::into_inner).commit().map_err(CliError::Output)
    }
}
