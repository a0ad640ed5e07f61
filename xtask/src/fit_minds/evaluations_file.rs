//! The file in which evaluations are kept: one JSON object a line.

use super::subject::Figures;
use phase_cli::error::CliError;
use phase_dataset::{FileError, Problem, WriteError};
use serde::{Deserialize, Serialize};
use std::{
    fs::{File, OpenOptions, read_to_string},
    io::{self, Write},
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

/// One evaluation.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub(super) struct Line {
    /// Names everything that determines it.
    pub(super) key: String,
    /// The event's id, for readers.
    pub(super) event: String,
    /// The figures.
    #[serde(flatten)]
    pub(super) figures: Figures,
}

/// A file to which evaluations are added as they are done.
#[derive(Debug)]
pub(super) struct EvaluationsFile {
    path: PathBuf,
    file: Mutex<File>,
}

impl EvaluationsFile {
    /// Opens the file beside another, or begins it; returns the evaluations in it, too. A line that is no evaluation,
    /// such as the last one of a run that was killed, is skipped.
    ///
    /// # Errors
    /// If it cannot be read or written.
    pub(super) fn beside(out: &Path) -> Result<(Self, Vec<Line>), CliError> {
        let path = out.with_extension("evaluations.jsonl");
        let text = match read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
            Err(error) => {
                return Err(CliError::File(FileError { file: path, problem: Problem::Unreadable(error) }));
            }
        };
        let lines = text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
        let opened = OpenOptions::new().create(true).append(true).open(&path);
        let mut file = opened.map_err(|source| failed(&path, source))?;
        if !text.is_empty() && !text.ends_with('\n') {
            file.write_all(b"\n").map_err(|source| failed(&path, source))?;
        }
        Ok((Self { path, file: Mutex::new(file) }, lines))
    }

    /// The file.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Adds an evaluation.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(super) fn add(&self, line: &Line) -> Result<(), CliError> {
        let text = serde_json::to_string(line);
        let text = text.map_err(|source| CliError::Serialise { what: "an evaluation", source })? + "\n";
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.write_all(text.as_bytes()).map_err(|source| failed(&self.path, source))
    }
}

fn failed(path: &Path, source: io::Error) -> CliError {
    CliError::Write(WriteError { path: path.to_owned(), action: "write the file", source })
}

#[cfg(test)]
mod tests {
    use super::{EvaluationsFile, Line};
    use crate::fit_minds::subject::Figures;
    use std::fs;

    #[test]
    fn a_line_cut_off_is_skipped_and_the_next_one_is_whole() {
        let folder = tempfile::tempdir().expect("a folder");
        let out = folder.path().join("fit.json");
        let figures = Figures { log_posterior: -0.1, log_likelihood: -1.3, chance: 0.4, cpu_seconds: 1e-3 };
        let line = |key: &str| Line { key: key.into(), event: "e".into(), figures };
        let (file, lines) = EvaluationsFile::beside(&out).expect("opened");
        assert!(lines.is_empty());
        file.add(&line("a")).expect("added");
        file.add(&line("b")).expect("added");
        let whole = fs::read(file.path()).expect("read");
        fs::write(file.path(), &whole[..whole.len() - 5]).expect("cut off");
        let (file, lines) = EvaluationsFile::beside(&out).expect("opened");
        assert_eq!(lines, [line("a")]);
        file.add(&line("c")).expect("added");
        assert_eq!(EvaluationsFile::beside(&out).expect("opened").1, [line("a"), line("c")]);
    }
}
