//! Answers in one SQLite file.
//!
//! Tables are only added to: no row is ever changed, and none is removed unless a rater leaves; triggers of
//! the database see to it. An operation is one transaction, which is in the file and on the disk when it is
//! acknowledged (`journal_mode=DELETE`, `synchronous=EXTRA`): a copy of the file has all answers. A
//! write-ahead log would be faster, and a copy without it empty.

mod error;
mod file;
mod read;
mod schema;

pub use error::{StoreError, StoreProblem};
pub use file::{Answers, backup};

use crate::{
    config::StudyConfig,
    fit,
    forms::Forms,
    question::Responses,
    record::{Departure, GivenAnswer, Millis, Rater},
};
use rusqlite::{Connection, OpenFlags, Transaction, TransactionBehavior, params};
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    time::Duration,
};

/// Time for which a transaction waits for another program's.
const PATIENCE: Duration = Duration::from_secs(10);

/// Pages before the first trial, as the table `page` names them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Page {
    Consent,
    Demographics,
    Instructions,
}

impl Page {
    const ALL: [Self; 3] = [Self::Consent, Self::Demographics, Self::Instructions];

    const fn name(self) -> &'static str {
        match self {
            Self::Consent => "consent",
            Self::Demographics => "demographics",
            Self::Instructions => "instructions",
        }
    }
}

/// The file with the answers of a study.
#[derive(Debug)]
pub struct Store {
    connection: Connection,
    path: PathBuf,
}

impl Store {
    /// Opens the answers of a study of this name and form, or makes an empty file for them.
    ///
    /// # Errors
    /// [`StoreError`] if the file cannot be made or opened, is something else, is of another study, or was
    /// written by a newer program.
    pub fn open(path: &Path, name: &str, form: &str) -> Result<Self, StoreError> {
        let flags = OpenFlags::SQLITE_OPEN_READ_WRITE
            | OpenFlags::SQLITE_OPEN_CREATE
            | OpenFlags::SQLITE_OPEN_NO_MUTEX;
        let failed = |problem| StoreError { file: path.to_owned(), problem };
        let connection = Connection::open_with_flags(path, flags).map_err(|error| failed(error.into()))?;
        let mut store = Self { connection, path: path.to_owned() };
        store.prepare(name, form).map_err(failed)?;
        Ok(store)
    }

    fn prepare(&mut self, name: &str, form: &str) -> Result<(), StoreProblem> {
        self.connection.busy_timeout(PATIENCE)?;
        let transaction = self.connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
        if schema::is_new(&transaction)? {
            schema::make(&transaction, name, form)?;
        }
        schema::identify(&transaction, name, form)?;
        schema::check(&transaction)?;
        schema::make_secret(&transaction)?;
        transaction.commit()?;
        self.connection.pragma_update(None, "journal_mode", "DELETE")?;
        self.connection.pragma_update(None, "synchronous", "EXTRA")?;
        self.connection.pragma_update(None, "foreign_keys", true)?;
        self.connection.pragma_update(None, "secure_delete", true)?;
        Ok(())
    }

    /// Random bytes that were drawn when the file was made.
    pub(crate) fn secret(&self) -> Result<Vec<u8>, StoreError> {
        let read = self.connection.query_row("SELECT bytes FROM secret", [], |row| row.get(0));
        read.map_err(|error| StoreError::of(&self.path, error))
    }

    /// All raters in the order in which they came.
    ///
    /// # Errors
    /// [`StoreError`].
    pub fn raters(&mut self) -> Result<Vec<Rater>, StoreError> {
        self.write(|store| store.raters())
    }

    /// Checks that raters' answers are some that the study can have been given.
    pub(crate) fn fits(
        &self,
        config: &StudyConfig,
        forms: &Forms,
        raters: &[Rater],
    ) -> Result<(), StoreError> {
        fit::check(config, forms, raters)
            .map_err(|misfit| StoreError { file: self.path.clone(), problem: misfit.into() })
    }

    /// Runs an operation as one transaction, which is undone if it fails.
    pub(crate) fn write<T, E: From<StoreError>>(
        &mut self,
        operation: impl FnOnce(&Writing<'_>) -> Result<T, E>,
    ) -> Result<T, E> {
        let begun = self.connection.transaction_with_behavior(TransactionBehavior::Immediate);
        let transaction = begun.map_err(|error| StoreError::of(&self.path, error))?;
        let writing = Writing { transaction, path: &self.path };
        let result = operation(&writing)?;
        writing.transaction.commit().map_err(|error| StoreError::of(&self.path, error))?;
        Ok(result)
    }
}

/// A transaction.
pub(crate) struct Writing<'a> {
    transaction: Transaction<'a>,
    path: &'a Path,
}

impl Writing<'_> {
    fn failed(&self, error: rusqlite::Error) -> StoreError {
        StoreError::of(self.path, error)
    }

    fn execute(&self, sql: &str, values: impl rusqlite::Params) -> Result<(), StoreError> {
        let statement = self.transaction.prepare_cached(sql);
        let done = statement.and_then(|mut statement| statement.execute(values));
        done.map(|_| ()).map_err(|error| self.failed(error))
    }

    /// Adds a rater with what it came with, and returns its number. The column `identity` stays empty: what
    /// one comes with does not say who one is.
    pub(crate) fn add_rater(
        &self,
        joined: Millis,
        parameters: &BTreeMap<String, String>,
    ) -> Result<u64, StoreError> {
        self.execute("INSERT INTO rater (joined) VALUES (?1)", [joined])?;
        let number = self.transaction.last_insert_rowid();
        let text = serde_json::Value::from_iter(
            parameters.iter().map(|(name, value)| (name.clone(), value.clone())),
        );
        let sql = "INSERT INTO origin (rater, parameters) VALUES (?1, ?2)";
        self.execute(sql, params![number, text.to_string()])?;
        Ok(number.unsigned_abs())
    }

    /// Adds a token of a rater by its digest.
    pub(crate) fn add_token(&self, rater: u64, digest: &[u8; 32]) -> Result<(), StoreError> {
        self.execute("INSERT INTO token (digest, rater) VALUES (?1, ?2)", params![digest, rater as i64])
    }

    /// Notes that a rater is done with a page.
    pub(crate) fn add_page(
        &self,
        rater: u64,
        page: Page,
        at: Millis,
        answer: Option<&Responses>,
    ) -> Result<(), StoreError> {
        let text = answer.map(|answer| answer.to_json().to_string());
        let sql = "INSERT INTO page (rater, page, at, answer) VALUES (?1, ?2, ?3, ?4)";
        self.execute(sql, params![rater as i64, page.name(), at, text])
    }

    /// Adds the trials of a rater: ids, and which of them are catch trials.
    pub(crate) fn add_trials(&self, rater: u64, trials: &[(&str, bool)]) -> Result<(), StoreError> {
        let sql = "INSERT INTO trial (rater, number, shown, catch) VALUES (?1, ?2, ?3, ?4)";
        for (k, (shown, catch)) in trials.iter().enumerate() {
            self.execute(sql, params![rater as i64, k as i64, shown, catch])?;
        }
        Ok(())
    }

    /// Adds the answer to a trial (index from 0).
    pub(crate) fn add_answer(&self, rater: u64, trial: usize, given: &GivenAnswer) -> Result<(), StoreError> {
        let sql = "INSERT INTO answer (rater, number, at, answer, response_time, plays) VALUES (?1, ?2, ?3, ?4, ?5, ?6)";
        let answer = given.answer.to_json().to_string();
        self.execute(
            sql,
            params![rater as i64, trial as i64, given.at, answer, given.response_time, given.plays],
        )
    }

    /// Deletes all that a rater gave and what it came with, and notes that it left.
    pub(crate) fn depart(&self, rater: u64, at: Millis, departure: Departure) -> Result<(), StoreError> {
        let sql = "INSERT INTO departure (rater, at, kind) VALUES (?1, ?2, ?3)";
        self.execute(sql, params![rater as i64, at, read::departure_name(departure)])?;
        for table in schema::OF_RATERS {
            self.execute(&format!("DELETE FROM {table} WHERE rater = ?1"), [rater as i64])?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_acknowledged_is_on_the_disk() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(&folder.path().join("a.sqlite"), "a", "goals").unwrap();
        let number =
            |pragma| store.connection.pragma_query_value(None, pragma, |row| row.get::<_, i64>(0)).unwrap();
        let mode: String =
            store.connection.pragma_query_value(None, "journal_mode", |row| row.get(0)).unwrap();
        // https://www.sqlite.org/pragma.html#pragma_synchronous: 3 is EXTRA.
        assert_eq!(
            (mode.as_str(), number("synchronous"), number("foreign_keys"), number("secure_delete")),
            ("delete", 3, 1, 1)
        );
    }
}
