//! Why a file of answers cannot be used.

use crate::fit::Misfit;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A problem with a file of answers.
#[derive(Debug, Error)]
#[error("{}: {problem}", file.display())]
pub struct StoreError {
    /// The file.
    pub file: PathBuf,
    /// The problem, which does not name the file.
    #[source]
    pub problem: StoreProblem,
}

/// A problem with a file of answers, in words that do not name the file.
#[derive(Debug, Error)]
pub enum StoreProblem {
    /// There is no such file.
    #[error("no such file; `phase serve` makes it when the study begins")]
    Absent,
    /// It is a file of something else.
    #[error("is not a file with answers of a study")]
    Foreign,
    /// Another program wrote it.
    #[error(
        "has version {found} of its tables; this program knows version {}",
        super::schema::SCHEMA_VERSION
    )]
    Version {
        /// Its version.
        found: i32,
    },
    /// It belongs to another study.
    #[error("has the answers of the study {name:?} with the form {form:?}, not of this one")]
    OtherStudy {
        /// The name of that study.
        name: String,
        /// Its form.
        form: String,
    },
    /// A table, view or trigger is not one of a study; in words.
    #[error("{0}")]
    Tables(String),
    /// The study cannot have been answered so: its configuration was changed, or its answers were.
    #[error("does not fit the configuration of the study: rater {rater} {what}")]
    Misfit {
        /// The rater.
        rater: u64,
        /// The misfit, as the rest of a sentence about the rater.
        what: String,
    },
    /// Something in it is not as it was written.
    #[error("is damaged: rater {rater}: {what}")]
    Damaged {
        /// The rater.
        rater: u64,
        /// The damage, in a clause.
        what: String,
    },
    /// The database gives such names to files of its own, and removes them.
    #[error("cannot be a copy: a name that ends in -wal, -shm or -journal belongs to the database")]
    Reserved,
    /// It is not whole.
    #[error(
        "is damaged, as a copy made while somebody answered may be; `phase study backup` copies it whole"
    )]
    Torn,
    /// The database fails, for example because the disk is full.
    #[error("the database fails: {0}")]
    Database(#[source] rusqlite::Error),
}

impl From<Misfit> for StoreProblem {
    fn from((rater, what): Misfit) -> Self {
        Self::Misfit { rater, what }
    }
}

impl From<rusqlite::Error> for StoreProblem {
    fn from(error: rusqlite::Error) -> Self {
        match error.sqlite_error_code() {
            Some(rusqlite::ErrorCode::NotADatabase) => Self::Foreign,
            Some(rusqlite::ErrorCode::DatabaseCorrupt) => Self::Torn,
            _ => Self::Database(error),
        }
    }
}

impl StoreError {
    /// Whether the disk is full: no fault of whoever chose the place.
    #[must_use]
    pub fn is_full(&self) -> bool {
        matches!(&self.problem, StoreProblem::Database(error)
            if error.sqlite_error_code() == Some(rusqlite::ErrorCode::DiskFull))
    }

    pub(super) fn of(path: &Path, error: rusqlite::Error) -> Self {
        Self { file: path.to_owned(), problem: error.into() }
    }
}
