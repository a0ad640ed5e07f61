//! The file of answers.

use crate::support::{begin, document, forms, open, parameters, read, submission, token_of};
use phase_study::{
    forms::Form,
    store::{Store, StoreProblem},
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

    assert!(matches!(
        Store::open_existing(&path, "a", "goals").expect_err("none").problem,
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
    assert!(matches!(&refused, StudyError::Unknown { rater: 1, shown } if shown == "event-0"), "{refused}");
}
