//! A file of answers that is only read, wherever it lies, and copies of one.

use super::{PATIENCE, StoreError, StoreProblem, Writing, schema};
use crate::{config::StudyConfig, fit, forms::Forms, record::Rater};
use phase_files::regular;
use rusqlite::{Connection, ErrorCode, OpenFlags, TransactionBehavior};
use std::{
    ffi::OsString,
    fmt::Write as _,
    io::Read as _,
    path::{Path, PathBuf},
};

/// Bytes 18 and 19 of a database that has a write-ahead log (<https://www.sqlite.org/fileformat.html>).
const HAS_LOG: [u8; 2] = [2, 2];

/// Everything in a file of answers, which was opened to be read.
#[derive(Clone, PartialEq, Debug)]
pub struct Answers {
    /// All raters in the order in which they came.
    pub raters: Vec<Rater>,
    /// The write-ahead log that the file had when it was copied, and that is not beside it: answers may be
    /// missing. Only files of earlier versions have one.
    pub missing_log: Option<PathBuf>,
}

impl Answers {
    /// Reads the answers of a study from a file, which is not changed and need not be writable.
    ///
    /// # Errors
    /// [`StoreError`] if there is no such file, it is something else or of another study, it was written by a
    /// newer program, it is damaged, or it has what the study cannot have been answered.
    pub fn read(path: &Path, config: &StudyConfig, forms: &Forms) -> Result<Self, StoreError> {
        let failed = |problem| StoreError { file: path.to_owned(), problem };
        // Before it is opened, which may make an empty one.
        let missing_log = missing_log(path);
        let mut connection = open(path)?;
        let begun = connection.transaction_with_behavior(TransactionBehavior::Deferred);
        let transaction = begun.map_err(|error| failed(error.into()))?;
        schema::identify(&transaction, &config.name, config.form.name()).map_err(failed)?;
        schema::check(&transaction).map_err(failed)?;
        check_length(&transaction, path).map_err(failed)?;
        let raters = Writing { transaction, path }.raters()?;
        fit::check(config, forms, &raters).map_err(|misfit| failed(misfit.into()))?;
        Ok(Self { raters, missing_log })
    }
}

/// Copies the answers of a study, while raters answer or not, into a file that is empty or does not exist.
///
/// # Errors
/// [`StoreError`] if the file is none of a study or damaged, or the copy cannot be written or has a name that
/// belongs to the database.
pub fn backup(from: &Path, to: &Path) -> Result<(), StoreError> {
    let name = to.as_os_str().as_encoded_bytes();
    if ["-wal", "-shm", "-journal"].iter().any(|ending| name.ends_with(ending.as_bytes())) {
        return Err(StoreError { file: to.to_owned(), problem: StoreProblem::Reserved });
    }
    let failed = |problem| StoreError { file: from.to_owned(), problem };
    let connection = open(from)?;
    if schema::number(&connection, "application_id").map_err(failed)? != schema::APPLICATION {
        return Err(failed(StoreProblem::Foreign));
    }
    schema::check(&connection).map_err(failed)?;
    check_length(&connection, from).map_err(failed)?;
    // An address has paths that are not text, too.
    let copied = connection.execute("VACUUM INTO ?1", [address(to)]);
    copied.map(|_| ()).map_err(|error| StoreError::of(to, error))
}

/// Opens a file to read it.
fn open(path: &Path) -> Result<Connection, StoreError> {
    if !path.is_file() {
        return Err(StoreError { file: path.to_owned(), problem: StoreProblem::Absent });
    }
    let reading = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let writing = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let is_refused = |error: &rusqlite::Error| {
        let code = error.sqlite_error_code();
        matches!(code, Some(ErrorCode::CannotOpen | ErrorCode::ReadOnly | ErrorCode::SystemIoFailure))
    };
    let first = match attempt(Connection::open_with_flags(path, reading)) {
        Err(error) if is_refused(&error) => error,
        opened => return opened.map_err(|error| StoreError::of(path, error)),
    };
    // What a server that was killed has left beside it is taken up or undone first, which needs writing.
    if let Ok(connection) = attempt(Connection::open_with_flags(path, writing)) {
        return Ok(connection);
    }
    // Where nothing is left, and nothing can be written beside it, nobody changes it either.
    let left = [beside(path, "-wal"), beside(path, "-journal")];
    if left.iter().all(|file| is_nothing(file)) {
        let flags = reading | OpenFlags::SQLITE_OPEN_URI;
        if let Ok(connection) = attempt(Connection::open_with_flags(address(path) + "?immutable=1", flags)) {
            return Ok(connection);
        }
    }
    Err(StoreError::of(path, first))
}

/// A connection that can be read from.
fn attempt(opened: rusqlite::Result<Connection>) -> rusqlite::Result<Connection> {
    let connection = opened?;
    connection.busy_timeout(PATIENCE)?;
    connection.query_row("SELECT count(*) FROM sqlite_schema", [], |_| Ok(()))?;
    Ok(connection)
}

/// Checks that nothing is missing at the end of a file, which the database itself fills with zeros. A log may
/// have its last pages.
fn check_length(connection: &Connection, path: &Path) -> Result<(), StoreProblem> {
    if !is_nothing(&beside(path, "-wal")) {
        return Ok(());
    }
    let number = |pragma| connection.pragma_query_value(None, pragma, |row| row.get::<_, i64>(0));
    let length = number("page_count")? * number("page_size")?;
    let found = path.metadata().map_or(0, |file| file.len());
    if i64::try_from(found).is_ok_and(|found| found >= length) { Ok(()) } else { Err(StoreProblem::Torn) }
}

/// The address of a file (<https://www.sqlite.org/uri.html>).
fn address(path: &Path) -> String {
    let mut text = String::from("file:");
    for &byte in path.as_os_str().as_encoded_bytes() {
        if byte.is_ascii_alphanumeric() || matches!(byte, b'/' | b'.' | b'_' | b'-') {
            text.push(byte.into());
        } else {
            // A text can always be written to.
            let _ = write!(text, "%{byte:02X}");
        }
    }
    text
}

fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(ending);
    name.into()
}

/// The log of a file, if it has one of which nothing is there. A file that cannot be read is not known to
/// have one; the function that opens it says why.
fn missing_log(path: &Path) -> Option<PathBuf> {
    let mut head = Vec::new();
    regular::open(path).ok()?.take(20).read_to_end(&mut head).ok()?;
    let log = beside(path, "-wal");
    (head.get(18..20) == Some(&HAS_LOG[..]) && is_nothing(&log)).then_some(log)
}

fn is_nothing(file: &Path) -> bool {
    file.metadata().map_or(true, |file| file.len() == 0)
}
