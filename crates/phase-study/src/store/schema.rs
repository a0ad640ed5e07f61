//! The tables of a file of answers. A file has no others: a view in the place of a table may take for ever to
//! read, and a trigger may drop answers without a word.

use super::StoreProblem;
use rusqlite::Connection;
use std::collections::BTreeMap;

/// `PHst`, by which SQLite files of studies are known (`application_id`).
pub(super) const APPLICATION: i32 = 0x5048_7374;
/// Version of the tables (`user_version`).
pub(crate) const SCHEMA_VERSION: i32 = 1;

const SCHEMA: &str = "
CREATE TABLE study (name TEXT NOT NULL, form TEXT NOT NULL) STRICT;
CREATE TABLE rater (number INTEGER PRIMARY KEY AUTOINCREMENT, joined INTEGER NOT NULL) STRICT;
CREATE TABLE token (digest BLOB PRIMARY KEY, rater INTEGER NOT NULL REFERENCES rater) STRICT, WITHOUT ROWID;
CREATE TABLE origin (rater INTEGER PRIMARY KEY REFERENCES rater, identity TEXT UNIQUE, parameters TEXT NOT NULL) STRICT;
CREATE TABLE page (rater INTEGER NOT NULL REFERENCES rater, page TEXT NOT NULL, at INTEGER NOT NULL, answer TEXT,
    PRIMARY KEY (rater, page)) STRICT, WITHOUT ROWID;
CREATE TABLE trial (rater INTEGER NOT NULL REFERENCES rater, number INTEGER NOT NULL, shown TEXT NOT NULL,
    catch INTEGER NOT NULL, PRIMARY KEY (rater, number), UNIQUE (rater, shown)) STRICT, WITHOUT ROWID;
CREATE TABLE answer (rater INTEGER NOT NULL, number INTEGER NOT NULL, at INTEGER NOT NULL, answer TEXT NOT NULL,
    response_time INTEGER NOT NULL, plays INTEGER NOT NULL, PRIMARY KEY (rater, number),
    FOREIGN KEY (rater, number) REFERENCES trial) STRICT, WITHOUT ROWID;
CREATE TABLE departure (rater INTEGER PRIMARY KEY REFERENCES rater, at INTEGER NOT NULL, kind TEXT NOT NULL) STRICT;
";

/// Random bytes that only the server knows; files of earlier versions have none.
const SECRET: &str = "
CREATE TABLE IF NOT EXISTS secret (bytes BLOB NOT NULL) STRICT;
INSERT INTO secret SELECT randomblob(16) WHERE NOT EXISTS (SELECT 1 FROM secret);
";

/// All tables; no row of them is ever changed.
const TABLES: [&str; 8] = ["study", "rater", "token", "departure", "origin", "page", "trial", "answer"];
/// Those whose rows go when their rater leaves.
pub(super) const OF_RATERS: [&str; 4] = ["answer", "trial", "page", "origin"];

/// Triggers by which the database itself refuses changes, whatever program makes them.
fn triggers() -> String {
    let mut sql = String::new();
    for table in TABLES {
        let left = if OF_RATERS.contains(&table) {
            "WHEN NOT EXISTS (SELECT 1 FROM departure WHERE departure.rater = OLD.rater)"
        } else {
            ""
        };
        sql += &format!(
            "CREATE TRIGGER {table}_stays BEFORE UPDATE ON {table} BEGIN SELECT RAISE(ABORT, 'answers are never changed'); END;\n\
             CREATE TRIGGER {table}_is_kept BEFORE DELETE ON {table} {left} \
             BEGIN SELECT RAISE(ABORT, 'only who left is deleted'); END;\n"
        );
    }
    sql
}

/// Makes the tables in a database that has nothing in it, for a study of this name and form.
pub(super) fn make(connection: &Connection, name: &str, form: &str) -> Result<(), StoreProblem> {
    connection.execute_batch(SCHEMA)?;
    connection.execute_batch(&triggers())?;
    connection.execute("INSERT INTO study (name, form) VALUES (?1, ?2)", [name, form])?;
    connection.pragma_update(None, "application_id", APPLICATION)?;
    connection.pragma_update(None, "user_version", SCHEMA_VERSION)?;
    Ok(())
}

/// Makes the secret, unless there is one.
pub(super) fn make_secret(connection: &Connection) -> Result<(), StoreProblem> {
    Ok(connection.execute_batch(SECRET)?)
}

/// Whether a database has nothing in it.
pub(super) fn is_new(connection: &Connection) -> Result<bool, StoreProblem> {
    let tables: i64 = connection.query_row("SELECT count(*) FROM sqlite_schema", [], |row| row.get(0))?;
    Ok((number(connection, "application_id")?, number(connection, "user_version")?, tables) == (0, 0, 0))
}

pub(super) fn number(connection: &Connection, pragma: &str) -> Result<i32, StoreProblem> {
    Ok(connection.pragma_query_value(None, pragma, |row| row.get(0))?)
}

/// Checks that a database has the answers of a study of this name and form.
pub(super) fn identify(connection: &Connection, name: &str, form: &str) -> Result<(), StoreProblem> {
    let version = number(connection, "user_version")?;
    if number(connection, "application_id")? != APPLICATION {
        return Err(StoreProblem::Foreign);
    }
    if version != SCHEMA_VERSION {
        return Err(StoreProblem::Version { found: version });
    }
    // Before anything is read from what may not be a table.
    check_tables(connection)?;
    let mut statement = connection.prepare("SELECT name, form FROM study LIMIT 2")?;
    let found = statement.query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?;
    let found: Vec<(String, String)> = found.collect::<rusqlite::Result<_>>()?;
    match <[_; 1]>::try_from(found) {
        Ok([found]) if (found.0.as_str(), found.1.as_str()) == (name, form) => Ok(()),
        Ok([(name, form)]) => Err(StoreProblem::OtherStudy { name, form }),
        Err(_) => Err(StoreProblem::Foreign),
    }
}

/// By name the kind and the definition of everything in a database that somebody defined.
fn definitions(connection: &Connection) -> rusqlite::Result<BTreeMap<String, (String, Option<String>)>> {
    // Names that begin like this are the database's own.
    let sql = "SELECT name, type, sql FROM sqlite_schema \
               WHERE type IN ('view', 'trigger') OR name NOT LIKE 'sqlite\\_%' ESCAPE '\\'";
    let mut statement = connection.prepare(sql)?;
    let rows = statement.query_map([], |row| Ok((row.get(0)?, (row.get(1)?, row.get(2)?))))?;
    rows.collect()
}

/// Checks that everything in a database is as this program defines it, and all tables are there. Files of
/// earlier versions have fewer triggers.
fn check_tables(connection: &Connection) -> Result<(), StoreProblem> {
    let own = Connection::open_in_memory()?;
    make(&own, "", "")?;
    make_secret(&own)?;
    let (own, found) = (definitions(&own)?, definitions(connection)?);
    if let Some((name, (kind, _))) = found.iter().find(|(name, given)| own.get(*name) != Some(given)) {
        return Err(StoreProblem::Tables(format!("has a {kind} {name:?} that no study has")));
    }
    match TABLES.into_iter().find(|table| !found.contains_key(*table)) {
        Some(table) => Err(StoreProblem::Tables(format!("has no table {table:?}"))),
        None => Ok(()),
    }
}

/// Checks that a file is whole: one that was copied while it was written may not be.
pub(super) fn check(connection: &Connection) -> Result<(), StoreProblem> {
    let found: String = connection.query_row("PRAGMA quick_check(1)", [], |row| row.get(0))?;
    let lacks_another = connection.prepare("PRAGMA foreign_key_check")?.exists([])?;
    if found == "ok" && !lacks_another { Ok(()) } else { Err(StoreProblem::Torn) }
}
