//! The file of answers.

use crate::support::{begin, complete, document, forms, open, parameters, read, submission, token_of};
use phase_study::{
    forms::Form,
    store::{Answers, Store, StoreProblem, backup},
    study::Study,
};
use rusqlite::Connection;
use serde_json::{Value, json};
use std::fs;

#[test]
fn answers_are_there_after_the_program_is_gone() {
    let folder = tempfile::tempdir().expect("a folder");
    let document = document(Form::Relation, 3, 2, 3);
    let mut study = open(folder.path(), &document);
    let token = study.join(&parameters("p1"), 0, token_of(1)).expect("let in").token;
    begin(&mut study, &token, 1);
    study.answer(&token, &submission(1, json!({"relation": "neutral"})), 2).expect("answered");
    let (before, stage) = (study.raters().expect("raters"), study.stage(&token).expect("a stage"));
    // Never closed, as if the program had been killed.
    std::mem::forget(study);
    let mut again = open(folder.path(), &document);
    assert_eq!(again.raters().expect("raters"), before);
    assert_eq!(again.stage(&token).expect("a stage"), stage);
}

#[test]
fn what_is_not_its_file_is_refused_and_left_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("answers.sqlite");
    let config = read(&document(Form::Relation, 3, 2, 3));
    let problem = |name: &str, form: &str| Store::open(&path, name, form).expect_err("refused").problem;
    fs::write(&path, "years of work, none of it a database".repeat(50)).expect("written");
    let before = fs::read(&path).expect("bytes");
    assert!(matches!(problem("a-study", "relation"), StoreProblem::Foreign));
    assert_eq!(fs::read(&path).expect("bytes"), before);
    fs::remove_file(&path).expect("removed");
    Connection::open(&path).and_then(|it| it.execute_batch("CREATE TABLE mine (x)")).expect("a database");
    assert!(matches!(problem("a-study", "relation"), StoreProblem::Foreign));
    fs::remove_file(&path).expect("removed");

    assert!(matches!(
        Answers::read(&path, &config, &forms()).expect_err("none").problem,
        StoreProblem::Absent
    ));
    drop(Store::open(&path, "a-study", "relation").expect("new"));
    assert!(matches!(problem("other", "relation"), StoreProblem::OtherStudy { .. }));
    assert!(matches!(problem("a-study", "goals"), StoreProblem::OtherStudy { .. }));
    Connection::open(&path).and_then(|it| it.pragma_update(None, "user_version", 2)).expect("newer");
    assert!(matches!(problem("a-study", "relation"), StoreProblem::Version { found: 2 }));
    assert!(Store::open(&folder.path().join("no/folder/x.sqlite"), "a", "goals").is_err());
}

#[test]
fn damage_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let document = document(Form::Relation, 3, 2, 3);
    let mut study = open(folder.path(), &document);
    let token = study.join(&parameters("p1"), 0, token_of(1)).expect("let in").token;
    begin(&mut study, &token, 1);
    study.answer(&token, &submission(1, json!({"relation": "neutral"})), 2).expect("answered");
    let other = Connection::open(folder.path().join("answers.sqlite")).expect("a database");
    for change in [
        "UPDATE answer SET answer = '{}'",
        "DELETE FROM answer",
        "DELETE FROM rater",
        "UPDATE rater SET joined = 0",
        "UPDATE trial SET shown = 'x'",
        "DELETE FROM page",
    ] {
        let refused = other.execute_batch(change).expect_err(change).to_string();
        assert!(refused.contains("never changed") || refused.contains("who left"), "{refused}");
    }
    other
        .execute_batch("DROP TRIGGER answer_stays; DROP TRIGGER answer_is_kept; DROP TRIGGER trial_is_kept")
        .expect("meddled");
    other.execute_batch("UPDATE answer SET answer = 'rubbish'").expect("damaged");
    let error = study.raters().expect_err("damaged").to_string();
    assert!(error.contains("rater 1"), "{error}");
    other.execute_batch("DELETE FROM answer; DELETE FROM trial WHERE number = 1").expect("damaged");
    let error = study.raters().expect_err("damaged").to_string();
    assert!(error.contains("trial 2 is missing"), "{error}");
}

#[test]
fn a_video_that_was_given_to_somebody_cannot_be_taken_away() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut document = document(Form::Relation, 3, 2, 3);
    let mut study = open(folder.path(), &document);
    let token = study.join(&parameters("p1"), 0, token_of(1)).expect("let in").token;
    begin(&mut study, &token, 1);
    drop(study);
    document["stimuli"][0]["id"] = json!("another");
    let config = read(&document);
    let store = Store::open(&folder.path().join("answers.sqlite"), &config.name, config.form.name())
        .expect("a store");
    let refused = Study::new(config, forms(), store).expect_err("refused");
    assert!(refused.to_string().contains("no video \"event-0\""), "{refused}");
}

/// A file in which views take for ever, and triggers drop answers, is none of a study.
#[test]
fn tables_are_those_of_a_study() {
    let config = read(&document(Form::Relation, 3, 2, 3));
    for (meddled, named) in [
        (
            "ALTER TABLE departure RENAME TO other; CREATE VIEW departure AS WITH RECURSIVE c (x) AS \
             (SELECT 1 UNION ALL SELECT x + 1 FROM c) SELECT x AS rater, 1 AS at, 'withdrew' AS kind FROM c",
            "departure",
        ),
        ("CREATE TRIGGER z BEFORE INSERT ON answer BEGIN SELECT RAISE(IGNORE); END", "trigger \"z\""),
        ("CREATE TABLE more (x)", "table \"more\""),
        ("CREATE INDEX i ON answer (at)", "index \"i\""),
        ("DROP TABLE answer", "no table \"answer\""),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("answers.sqlite");
        drop(answered(folder.path()));
        let other = Connection::open(&path).expect("a database");
        other.execute_batch("DROP TRIGGER answer_is_kept").expect("meddled");
        other.execute_batch(meddled).expect("meddled");
        let read = Answers::read(&path, &config, &forms()).expect_err(meddled);
        let opened = Store::open(&path, "a-study", "relation").expect_err(meddled);
        for error in [read, opened] {
            assert!(matches!(error.problem, StoreProblem::Tables(_)), "{meddled}: {error}");
            assert!(error.to_string().contains(named), "{meddled}: {error}");
        }
    }
}

/// Answers that the study as it is configured cannot have been given would be left out of tables, or count
/// otherwise.
#[test]
fn answers_fit_the_configuration() {
    let given = |document: &Value| read(document);
    let mut asked = document(Form::Relation, 3, 2, 3);
    asked["demographics"] = json!([
        {"name": "age", "text": "?", "kind": "whole", "from": 0, "to": 120},
        {"name": "hand", "text": "?", "kind": "one", "choices": ["left", "right"]},
    ]);
    asked["catch_trials"] = json!([{"id": "c", "video": "c.mp4", "expected": {"relation": "neutral"}}]);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("answers.sqlite");
    let mut study = open(folder.path(), &asked);
    complete(&mut study, "p1", 1, |_| json!({"relation": "friendly"})).expect("a rater");
    drop(study);
    assert!(Answers::read(&path, &given(&asked), &forms()).is_ok());
    // A question more takes nothing away, and what is expected may be corrected.
    let mut more = asked.clone();
    let third = json!({"name": "more", "text": "?", "kind": "text", "required": true});
    more["demographics"].as_array_mut().expect("questions").push(third);
    more["catch_trials"][0]["expected"] = json!({"relation": "friendly"});
    assert!(Answers::read(&path, &given(&more), &forms()).is_ok());
    let refused = |document: &Value, named: &str| {
        let config = given(document);
        let read = Answers::read(&path, &config, &forms()).expect_err(named);
        let store = Store::open(&path, &config.name, config.form.name()).expect("a store");
        let error = Study::new(config, forms(), store).expect_err(named).to_string();
        assert_eq!(read.to_string(), error);
        assert!(error.contains("rater 1") && error.contains(named), "{named}: {error}");
    };
    let changed = |change: &dyn Fn(&mut Value)| {
        let mut document = asked.clone();
        change(&mut document);
        document
    };
    refused(&changed(&|it| it["stimuli"][0]["id"] = json!("other")), "no video \"event-0\"");
    refused(&changed(&|it| it["catch_trials"] = json!([])), "no catch trial \"c\"");
    refused(&changed(&|it| it["demographics"][0]["name"] = json!("years")), "age");
    refused(
        &changed(&|it| it["demographics"][0] = json!({"name": "age", "text": "?", "kind": "text"})),
        "age",
    );
    refused(&changed(&|it| it["demographics"][1]["choices"] = json!(["l", "r"])), "hand");
    for (meddled, named) in [
        (
            "UPDATE answer SET answer = '{\"relation\": \"hateful\"}' WHERE number = 0",
            "in trial 1: field `relation`",
        ),
        ("UPDATE answer SET answer = '{\"other\": \"neutral\"}' WHERE number = 0", "in trial 1: "),
        ("UPDATE answer SET response_time = -5 WHERE number = 2", "in trial 3: response_time"),
        ("UPDATE answer SET plays = 9223372036854775807 WHERE number = 2", "in trial 3: plays"),
        ("UPDATE answer SET at = -9223372036854775808", "before 1970"),
        ("UPDATE answer SET at = 9223370000000000000", "after 2100"),
        ("UPDATE rater SET joined = joined + 90000000", "before they came"),
        ("DELETE FROM answer WHERE number = 1", "before the one that comes before"),
        ("DELETE FROM page WHERE page = 'consent'", "not agreed"),
        ("INSERT INTO departure VALUES (1, 5, 'withdrew')", "has left"),
    ] {
        let whole = fs::read(&path).expect("bytes");
        let other = Connection::open(&path).expect("a database");
        let dropped: Vec<String> = ["answer_stays", "answer_is_kept", "page_is_kept", "rater_stays"]
            .map(|trigger| format!("DROP TRIGGER {trigger};"))
            .into();
        other.execute_batch(&(dropped.concat() + meddled)).expect("meddled");
        drop(other);
        refused(&asked, named);
        fs::write(&path, whole).expect("restored");
    }
    // An answer to nothing.
    let other = Connection::open(&path).expect("a database");
    other
        .execute_batch(
            "PRAGMA foreign_keys = 0; DROP TRIGGER trial_is_kept; DELETE FROM trial WHERE number = 3",
        )
        .expect("meddled");
    let read = Answers::read(&path, &given(&asked), &forms()).expect_err("refused");
    assert!(matches!(read.problem, StoreProblem::Torn), "{read}");
}

/// A copy that lacks its end is not read as if zeros stood there.
#[test]
fn a_file_without_its_last_byte_is_refused() {
    let config = read(&document(Form::Relation, 3, 2, 3));
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("answers.sqlite");
    drop(answered(folder.path()));
    let whole = fs::read(&path).expect("bytes");
    fs::write(&path, &whole[..whole.len() - 1]).expect("written");
    let read = Answers::read(&path, &config, &forms()).expect_err("refused");
    assert!(matches!(read.problem, StoreProblem::Torn), "{read}");
    let saved = backup(&path, &folder.path().join("copy.sqlite")).expect_err("refused");
    assert!(matches!(saved.problem, StoreProblem::Torn), "{saved}");
}

/// A study in which somebody has answered twice, and is still open.
fn answered(folder: &std::path::Path) -> Study {
    let mut study = open(folder, &document(Form::Relation, 3, 2, 3));
    let token = study.join(&parameters("p1"), 0, token_of(1)).expect("let in").token;
    begin(&mut study, &token, 1);
    for trial in 1..=2 {
        study.answer(&token, &submission(trial, json!({"relation": "neutral"})), 2).expect("answered");
    }
    study
}

fn count(answers: &Answers) -> usize {
    let trials = answers.raters.iter().flat_map(|rater| &rater.trials);
    trials.filter(|trial| trial.given.is_some()).count()
}

/// The file alone is everything that was acknowledged, while the study runs.
#[test]
fn a_copy_has_all_answers() {
    let config = read(&document(Form::Relation, 3, 2, 3));
    let folder = tempfile::tempdir().expect("a folder");
    let mut study = answered(folder.path());
    let [file, copy, saved] =
        ["answers", "copy", "saved"].map(|name| folder.path().join(format!("{name}.sqlite")));
    fs::copy(&file, &copy).expect("copied");
    backup(&file, &saved).expect("saved");
    for path in [&file, &copy, &saved] {
        let read = Answers::read(path, &config, &forms()).expect("answers");
        assert_eq!((count(&read), &read.missing_log), (2, &None));
        assert_eq!(read.raters, study.raters().expect("raters"));
    }
    // What is there is not overwritten, and only answers are copied.
    assert!(backup(&file, &copy).is_err());
    fs::write(folder.path().join("x"), "rubbish".repeat(1000)).expect("written");
    assert!(backup(&folder.path().join("x"), &folder.path().join("y")).is_err());
    for ending in ["-wal", "-shm", "-journal"] {
        let refused = backup(&file, &folder.path().join(format!("answers.sqlite{ending}")));
        assert!(matches!(refused.expect_err("refused").problem, StoreProblem::Reserved));
    }
}

/// Paths are not text.
#[cfg(target_os = "linux")]
#[test]
fn a_backup_has_any_name() {
    use std::os::unix::ffi::OsStrExt as _;
    let config = read(&document(Form::Relation, 3, 2, 3));
    let folder = tempfile::tempdir().expect("a folder");
    drop(answered(folder.path()));
    let saved = folder.path().join(std::ffi::OsStr::from_bytes(b"a?b#c%41\xff.sqlite"));
    backup(&folder.path().join("answers.sqlite"), &saved).expect("saved");
    assert_eq!(count(&Answers::read(&saved, &config, &forms()).expect("answers")), 2);
}

/// A copy of an earlier version's file without its log says so.
#[test]
fn a_missing_log_is_told() {
    let config = read(&document(Form::Relation, 3, 2, 3));
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("answers.sqlite");
    drop(answered(folder.path()));
    let logging = Connection::open(&path).expect("a database");
    logging.pragma_update(None, "journal_mode", "WAL").expect("a log");
    logging.execute_batch("INSERT INTO rater (joined) VALUES (5)").expect("written");
    let copy = folder.path().join("copy.sqlite");
    fs::copy(&path, &copy).expect("copied");
    let read = Answers::read(&copy, &config, &forms()).expect("answers");
    assert_eq!((read.raters.len(), read.missing_log), (1, Some(folder.path().join("copy.sqlite-wal"))));
    let whole = Answers::read(&path, &config, &forms()).expect("answers");
    assert_eq!((whole.raters.len(), whole.missing_log), (2, None));
    // The server takes it up, and from then on there is none.
    drop(logging);
    drop(open(folder.path(), &document(Form::Relation, 3, 2, 3)));
    assert_eq!(&fs::read(&path).expect("bytes")[18..20], &[1, 1]);
}

/// What cannot be written can be read. Where the tests run as root, who may write everything, only what the
/// reading leaves behind is seen.
#[cfg(unix)]
#[test]
fn reading_needs_no_right_to_write() {
    use std::os::unix::fs::PermissionsExt as _;
    let config = read(&document(Form::Relation, 3, 2, 3));
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("answers.sqlite");
    drop(answered(folder.path()));
    let rights = |file, of_folder| {
        fs::set_permissions(&path, fs::Permissions::from_mode(file)).expect("set");
        fs::set_permissions(folder.path(), fs::Permissions::from_mode(of_folder)).expect("set");
    };
    for mode in ["DELETE", "WAL"] {
        Connection::open(&path).and_then(|it| it.pragma_update(None, "journal_mode", mode)).expect("set");
        let before = fs::read(&path).expect("bytes");
        rights(0o400, 0o500);
        let read = Answers::read(&path, &config, &forms());
        rights(0o600, 0o700);
        assert_eq!(count(&read.expect("answers")), 2, "{mode}");
        assert_eq!(fs::read(&path).expect("bytes"), before, "{mode}");
    }
}
