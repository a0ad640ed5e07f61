//! The file of answers.

use crate::support::{begin, document, forms, open, parameters, read, submission, token_of};
use phase_study::{
    forms::Form,
    store::{Answers, Store, StoreProblem, backup},
    study::{Study, StudyError},
};
use rusqlite::Connection;
use serde_json::json;
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
    let problem = |name: &str, form: &str| Store::open(&path, name, form).expect_err("refused").problem;
    fs::write(&path, "years of work, none of it a database".repeat(50)).expect("written");
    let before = fs::read(&path).expect("bytes");
    assert!(matches!(problem("a-study", "relation"), StoreProblem::Foreign));
    assert_eq!(fs::read(&path).expect("bytes"), before);
    fs::remove_file(&path).expect("removed");
    Connection::open(&path).and_then(|it| it.execute_batch("CREATE TABLE mine (x)")).expect("a database");
    assert!(matches!(problem("a-study", "relation"), StoreProblem::Foreign));
    fs::remove_file(&path).expect("removed");

    assert!(matches!(Answers::read(&path, "a", "goals").expect_err("none").problem, StoreProblem::Absent));
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
    assert!(matches!(&refused, StudyError::Unknown { rater: 1, shown } if shown == "event-0"), "{refused}");
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
    let folder = tempfile::tempdir().expect("a folder");
    let mut study = answered(folder.path());
    let [file, copy, saved] =
        ["answers", "copy", "saved"].map(|name| folder.path().join(format!("{name}.sqlite")));
    fs::copy(&file, &copy).expect("copied");
    backup(&file, &saved).expect("saved");
    for path in [&file, &copy, &saved] {
        let read = Answers::read(path, "a-study", "relation").expect("answers");
        assert_eq!((count(&read), &read.missing_log), (2, &None));
        assert_eq!(read.raters, study.raters().expect("raters"));
    }
    // What is there is not overwritten, and only answers are copied.
    assert!(backup(&file, &copy).is_err());
    fs::write(folder.path().join("x"), "rubbish".repeat(1000)).expect("written");
    assert!(backup(&folder.path().join("x"), &folder.path().join("y")).is_err());
}

/// A copy of an earlier version's file without its log says so.
#[test]
fn a_missing_log_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("answers.sqlite");
    drop(answered(folder.path()));
    let logging = Connection::open(&path).expect("a database");
    logging.pragma_update(None, "journal_mode", "WAL").expect("a log");
    logging.execute_batch("INSERT INTO rater (joined) VALUES (5)").expect("written");
    let copy = folder.path().join("copy.sqlite");
    fs::copy(&path, &copy).expect("copied");
    let read = Answers::read(&copy, "a-study", "relation").expect("answers");
    assert_eq!((read.raters.len(), read.missing_log), (1, Some(folder.path().join("copy.sqlite-wal"))));
    let whole = Answers::read(&path, "a-study", "relation").expect("answers");
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
        let read = Answers::read(&path, "a-study", "relation");
        rights(0o600, 0o700);
        assert_eq!(count(&read.expect("answers")), 2, "{mode}");
        assert_eq!(fs::read(&path).expect("bytes"), before, "{mode}");
    }
}
