//! A file in which evaluations are kept, so that an interrupted fit goes on where it was: one JSON object a
//! line.

use phase_files::{FileError, Problem, WriteError};
use phase_runs::error::RunError;
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::{
    fs::{File, OpenOptions, read_to_string},
    io::{self, Write},
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

/// One evaluation.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub(crate) struct Line<T> {
    /// Names everything that determines it.
    pub(crate) key: String,
    /// The event's id, for readers.
    pub(crate) event: String,
    /// The result of the evaluation.
    #[serde(flatten)]
    pub(crate) figures: T,
}

/// A file to which evaluations are added as they are done.
#[derive(Debug)]
pub(crate) struct EvaluationsFile {
    path: PathBuf,
    file: Mutex<File>,
}

impl EvaluationsFile {
    /// Opens the file beside another, or begins it; returns the evaluations in it, too. A line that is no
    /// evaluation, such as the last one of a run that was killed, is skipped.
    pub(crate) fn beside<T: DeserializeOwned>(out: &Path) -> Result<(Self, Vec<Line<T>>), RunError> {
        let path = out.with_extension("evaluations.jsonl");
        let text = match read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
            Err(error) => {
                return Err(RunError::File(FileError { file: path, problem: Problem::Unreadable(error) }));
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
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Adds an evaluation.
    pub(crate) fn add<T: Serialize>(&self, line: &Line<T>) -> Result<(), RunError> {
        let text = serde_json::to_string(line);
        let text = text.map_err(|source| RunError::Serialise { what: "an evaluation", source })? + "\n";
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.write_all(text.as_bytes()).map_err(|source| failed(&self.path, source))
    }
}

fn failed(path: &Path, source: io::Error) -> RunError {
    RunError::Write(WriteError { path: path.to_owned(), action: "write the file", source })
}

#[cfg(test)]
mod tests {
    use super::{EvaluationsFile, Line};
    use serde::{Deserialize, Serialize};
    use std::fs;

    #[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
    struct Figures {
        chance: f64,
    }

    #[test]
    fn a_line_cut_off_is_skipped_and_the_next_one_is_whole() {
        let folder = tempfile::tempdir().expect("a folder");
        let out = folder.path().join("fit.json");
        let figures = Figures { chance: 0.4 };
        let line = |key: &str| Line { key: key.into(), event: "e".into(), figures: figures.clone() };
        let (file, lines) = EvaluationsFile::beside::<Figures>(&out).expect("opened");
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
