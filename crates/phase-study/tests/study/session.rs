//! The way of a rater through a study.

use crate::support::{
    begin, complete, document, forms, open, parameters, random, read, some_answer, submission, token_of,
};
use phase_model::json::Field;
use phase_study::{
    forms::Form,
    question::Responses,
    record::{GivenAnswer, Standing, Trial},
    study::{Stage, StudyError, Token},
};
use proptest::prelude::*;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

const MINUTE: i64 = 60_000;

fn with_everything(form: Form) -> Value {
    let mut document = document(form, 6, 2, 3);
    document["demographics"] = json!([
        {"name": "age", "text": "How old are you?", "kind": "whole", "from": 18, "to": 120, "required": true},
        {"name": "sight", "text": "Do you see colours?", "kind": "one", "choices": ["yes", "no"]},
        {"name": "notes", "text": "Anything else?", "kind": "text", "longest": 20},
    ]);
    let expected = if form == Form::Interactions {
        json!({"interactions": "chasing"})
    } else {
        json!({"relation": "neutral"})
    };
    document["catch_trials"] = json!([{"id": "catch-0", "video": "catch.mp4", "expected": expected}]);
    document["completion"] = json!({"code": "ABC123", "url": "https://example.org/done?cc=ABC123"});
    document
}

#[test]
fn a_rater_goes_from_consent_to_the_code() {
    for form in Form::ALL {
        let folder = tempfile::tempdir().expect("a folder");
        let mut study = open(folder.path(), &with_everything(form));
        let joined = study.join(&parameters("p1"), 0, token_of(1)).expect("let in");
        assert!(matches!(joined.stage, Stage::Consent { .. }));
        // Who only looks is nobody yet.
        assert!(study.raters().expect("raters").is_empty());
        assert_eq!(study.stage(&joined.token).expect("a stage"), joined.stage);
        let token = Token::parse(&joined.token.text()).expect("a token");
        let stage = study.consent(&token, true, 1).expect("agreed");
        assert!(matches!(&stage, Stage::Demographics { questions } if questions.len() == 3));
        for rubbish in [
            json!(null),
            json!({}),
            json!({"age": 17}),
            json!({"age": "30"}),
            json!({"age": 30, "name": "x"}),
            json!({"age": 30, "notes": "a\nb"}),
        ] {
            assert!(
                matches!(study.demographics(&token, &rubbish, 2), Err(StudyError::Field(_))),
                "{rubbish}"
            );
        }
        let stage = study.demographics(&token, &json!({"age": 30}), 2).expect("said");
        assert!(matches!(stage, Stage::Instructions { .. }));
        let mut stage = study.instructed(&token, 3).expect("read");
        let mut videos = BTreeSet::new();
        for trial in 1..=4 {
            let Stage::Trial(page) = &stage else { panic!("{stage:?}") };
            assert_eq!((page.trial, page.trials), (trial, 4));
            let name = page
                .video
                .strip_prefix("videos/")
                .and_then(|it| it.strip_suffix(".mp4"))
                .expect("an address");
            assert!(study.video(name).is_some_and(|file| file.ends_with(".mp4")));
            assert!(videos.insert(page.video.clone()), "no video twice");
            let answer = some_answer(&page.questions, &mut random(trial as u64));
            stage = study.answer(&token, &submission(trial, answer), 4).expect("answered");
        }
        let Stage::Done { code, url } = stage else { panic!("{stage:?}") };
        assert_eq!(
            (code.as_deref(), url.as_deref()),
            (Some("ABC123"), Some("https://example.org/done?cc=ABC123"))
        );
        // Whoever comes with the same id is somebody else, who sees and changes nothing of the first.
        let again = study.join(&parameters("p1"), 9, token_of(2)).expect("let in");
        assert!(matches!(again.stage, Stage::Consent { .. }));
        assert!(matches!(study.withdraw(&again.token, 9), Err(StudyError::NotNow(_))));
        let answer = submission(1, json!({"relation": "neutral"}));
        assert!(matches!(study.answer(&again.token, &answer, 9), Err(StudyError::NotNow(_))));
        assert!(matches!(study.stage(&token).expect("a stage"), Stage::Done { .. }));
        assert_eq!(study.raters().expect("raters").len(), 1);
        study.consent(&again.token, true, 9).expect("agreed");
        study.withdraw(&again.token, 9).expect("withdrawn");
        let raters = study.raters().expect("raters");
        let answered = |k: usize| raters[k].trials.iter().filter(|trial| trial.given.is_some()).count();
        assert_eq!((raters.len(), answered(0), answered(1)), (2, 4, 0));
    }
}

#[test]
fn wrong_answers_are_refused_and_change_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut study = open(folder.path(), &document(Form::Relation, 3, 2, 2));
    let token = study.join(&BTreeMap::new(), 0, token_of(1)).expect("let in").token;
    let answer = json!({"relation": "neutral"});
    assert!(matches!(study.answer(&token, &submission(1, answer.clone()), 1), Err(StudyError::NotNow(_))));
    assert!(matches!(study.instructed(&token, 1), Err(StudyError::NotNow(_))));
    let first = begin(&mut study, &token, 1);
    let rubbish = [
        json!(null),
        json!({}),
        json!([]),
        submission(0, answer.clone()),
        submission(1, json!({})),
        submission(1, json!({"relation": "angry"})),
        submission(1, json!({"relation": ["neutral"]})),
        submission(1, json!({"relation": "neutral", "mood": "good"})),
        json!({"trial": 1, "answer": answer, "response_time": -1, "plays": 1}),
        json!({"trial": 1, "answer": answer, "response_time": 10, "plays": 0}),
        json!({"trial": 1, "answer": answer, "response_time": 10, "plays": 1, "catch": true}),
    ];
    for wrong in rubbish {
        assert!(matches!(study.answer(&token, &wrong, 1), Err(StudyError::Field(_))), "{wrong}");
    }
    for trial in [2, 3, 4_000_000_000_usize] {
        assert!(matches!(
            study.answer(&token, &submission(trial, answer.clone()), 1),
            Err(StudyError::NotNow(_))
        ));
    }
    assert_eq!(study.stage(&token).expect("a stage"), first);
    let second = study.answer(&token, &submission(1, answer.clone()), 2).expect("answered");
    assert_eq!(study.answer(&token, &submission(1, answer), 3).expect("acknowledged"), second);
    let other = study.answer(&token, &submission(1, json!({"relation": "friendly"})), 3);
    assert!(matches!(other, Err(StudyError::OtherAnswer)));
    assert_eq!(study.stage(&token).expect("a stage"), second);
    let stranger = Token::parse(&"0".repeat(32)).expect("a token");
    assert!(matches!(study.stage(&stranger), Err(StudyError::Token)));
    assert!(Token::parse("x").is_none() && Token::parse(&"é".repeat(16)).is_none());
}

#[test]
fn a_refusal_leaves_nothing_and_takes_no_place() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut study = open(folder.path(), &document(Form::Relation, 2, 1, 2));
    let token = study.join(&parameters("p1"), 0, token_of(1)).expect("let in").token;
    assert!(matches!(study.withdraw(&token, 1), Err(StudyError::NotNow(_))));
    assert_eq!(study.consent(&token, false, 1).expect("refused"), Stage::Declined);
    assert_eq!(study.consent(&token, false, 1).expect("refused"), Stage::Declined);
    assert!(matches!(study.consent(&token, true, 1), Err(StudyError::NotNow(_))));
    let raters = study.raters().expect("raters");
    assert_eq!(raters[0].standing(study.config()), Standing::Declined);
    assert!(raters[0].parameters.is_empty());
    assert!(complete(&mut study, "p2", 2, |_| json!({"relation": "neutral"})).is_some());
}

#[test]
fn the_study_is_full_and_places_of_who_is_gone_are_free_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut study = open(folder.path(), &document(Form::Relation, 2, 1, 2));
    let token = study.join(&parameters("p1"), 0, token_of(1)).expect("let in").token;
    let late = study.join(&parameters("p3"), 0, token_of(3)).expect("let in").token;
    begin(&mut study, &token, 0);
    assert_eq!(study.join(&parameters("p2"), MINUTE, token_of(2)).expect("told").stage, Stage::Full);
    // One who was reading when the last place was taken is told, and may come again.
    assert_eq!(study.consent(&late, true, MINUTE).expect("told"), Stage::Full);
    study.answer(&token, &submission(1, json!({"relation": "neutral"})), 10 * MINUTE).expect("answered");
    assert_eq!(study.join(&parameters("p2"), 70 * MINUTE, token_of(2)).expect("told").stage, Stage::Full);
    assert!(matches!(begin(&mut study, &late, 71 * MINUTE), Stage::Trial(_)));
    // Whoever was gone for long can still finish.
    let stage =
        study.answer(&token, &submission(2, json!({"relation": "neutral"})), 90 * MINUTE).expect("answered");
    assert!(matches!(stage, Stage::Done { .. }));
}

#[test]
fn who_fails_the_catch_trials_does_not_count() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut document = with_everything(Form::Relation);
    document["videos_per_rater"] = json!(6);
    document["raters_per_video"] = json!(1);
    let mut study = open(folder.path(), &document);
    assert!(complete(&mut study, "p1", 1, |_| json!({"relation": "friendly"})).is_some());
    let raters = study.raters().expect("raters");
    assert_eq!(raters[0].standing(study.config()), Standing::Failed);
    assert_eq!(raters[0].catch_failures(study.config()), 1);
    assert!(complete(&mut study, "p2", 2, |_| json!({"relation": "neutral"})).is_some());
    assert_eq!(study.raters().expect("raters")[1].standing(study.config()), Standing::Complete);
    assert_eq!(study.join(&parameters("p3"), 3, token_of(3)).expect("told").stage, Stage::Full);
}

#[test]
fn who_withdraws_is_deleted_and_the_place_is_free() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut document = with_everything(Form::Relation);
    document["raters_per_video"] = json!(1);
    document["videos_per_rater"] = json!(6);
    let mut study = open(folder.path(), &document);
    let joined = study.join(&parameters("A-PERSON-4711"), 0, token_of(1)).expect("let in");
    study.consent(&joined.token, true, 0).expect("agreed");
    study.demographics(&joined.token, &json!({"age": 30, "notes": "a secret 4712"}), 0).expect("said");
    study.instructed(&joined.token, 0).expect("read");
    study.answer(&joined.token, &submission(1, json!({"relation": "neutral"})), 0).expect("answered");
    let bytes = || {
        let files = std::fs::read_dir(folder.path()).expect("a folder");
        files
            .flat_map(|file| std::fs::read(file.expect("a file").path()).expect("bytes"))
            .collect::<Vec<u8>>()
    };
    let has = |text: &str| bytes().windows(text.len()).any(|window| window == text.as_bytes());
    assert!(has("A-PERSON-4711") && has("a secret 4712"));
    assert_eq!(study.withdraw(&joined.token, 5).expect("withdrawn"), Stage::Withdrawn);
    assert!(!has("A-PERSON-4711") && !has("a secret 4712"), "nothing is left in any file");
    assert_eq!(study.withdraw(&joined.token, 6).expect("withdrawn"), Stage::Withdrawn);
    assert_eq!(study.stage(&joined.token).expect("a stage"), Stage::Withdrawn);
    let late = study.answer(&joined.token, &submission(2, json!({"relation": "neutral"})), 7);
    assert!(matches!(late, Err(StudyError::NotNow(_))));
    let raters = study.raters().expect("raters");
    assert!(
        raters[0].trials.is_empty() && raters[0].demographics.is_none() && raters[0].parameters.is_empty()
    );
    assert!(complete(&mut study, "p2", 8, |_| json!({"relation": "neutral"})).is_some());
}

#[test]
fn members_of_the_address_are_checked() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut document = document(Form::Relation, 2, 1, 2);
    document["identity_required"] = json!(true);
    let mut study = open(folder.path(), &document);
    for wrong in ["", "a\nb", &"x".repeat(201)] {
        let refused = study.join(&parameters(wrong), 0, token_of(1)).expect_err("refused").to_string();
        assert!(refused.contains("PROLIFIC_PID"), "{refused}");
    }
    let mut more = parameters("p1");
    more.insert("SESSION_ID".into(), "s".into());
    more.insert("utm_source".into(), "not kept".into());
    let token = study.join(&more, 0, token_of(1)).expect("let in").token;
    study.consent(&token, true, 0).expect("agreed");
    let kept: Vec<String> = study.raters().expect("raters")[0].parameters.keys().cloned().collect();
    assert_eq!(kept, ["PROLIFIC_PID", "SESSION_ID"]);
}

#[test]
fn exactly_as_many_raters_as_are_wanted_finish() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut study = open(folder.path(), &document(Form::Relation, 10, 3, 4));
    let answer = |_: &_| json!({"relation": "neutral"});
    let done = (0..20).filter(|k| {
        let joined = study.join(&parameters(&format!("p{k}")), *k, token_of(*k as u64)).expect("told");
        joined.stage != Stage::Full && complete(&mut study, &format!("p{k}"), *k, answer).is_some()
    });
    assert_eq!(done.count(), 8);
    let mut counts = BTreeMap::<String, usize>::new();
    for trial in study.raters().expect("raters").into_iter().flat_map(|rater| rater.trials) {
        *counts.entry(trial.shown).or_default() += 1;
    }
    assert!(counts.len() == 10 && counts.values().all(|&raters| raters == 3), "{counts:?}");
}

/// Any JSON, often with names that answers have.
fn anything() -> impl Strategy<Value = Value> {
    let names = prop_oneof![
        Just("trial".to_owned()),
        Just("answer".to_owned()),
        Just("relation".to_owned()),
        Just("response_time".to_owned()),
        Just("plays".to_owned()),
        Just("age".to_owned()),
        any::<String>(),
    ];
    let leaf = prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::from),
        any::<i64>().prop_map(Value::from),
        any::<f64>().prop_map(Value::from),
        any::<String>().prop_map(Value::from),
        Just(json!(1)),
        Just(json!("neutral")),
    ];
    leaf.prop_recursive(4, 24, 6, move |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..4).prop_map(Value::from),
            prop::collection::btree_map(names.clone(), inner, 0..6)
                .prop_map(|members| Value::Object(members.into_iter().collect())),
        ]
    })
}

#[test]
fn nothing_that_is_sent_makes_it_panic_or_is_stored_in_part() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut study = open(folder.path(), &with_everything(Form::Relation));
    let token = study.join(&parameters("p1"), 0, token_of(1)).expect("let in").token;
    begin(&mut study, &token, 0);
    let before = study.raters().expect("raters");
    let study = std::cell::RefCell::new(study);
    proptest!(ProptestConfig::with_cases(200), |(value in anything())| {
        let mut study = study.borrow_mut();
        let trial = study.answer(&token, &value, 1).is_ok();
        let answered = trial || study.demographics(&token, &value, 1).is_ok();
        prop_assert!(answered || study.raters().expect("raters") == before);
    });
}

/// To come costs the same, however many have come.
#[test]
fn nobody_waits_for_those_who_came_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut study = open(folder.path(), &document(Form::Relation, 200, 2000, 20));
    let time = |study: &mut phase_study::study::Study, from: u64| {
        let begun = std::time::Instant::now();
        for k in from..from + 200 {
            study.join(&parameters("p"), 0, token_of(k)).expect("let in");
        }
        begun.elapsed()
    };
    let few = time(&mut study, 0);
    for k in 0..400 {
        let token = study.join(&parameters("p"), 0, token_of(10_000 + k)).expect("let in").token;
        study.consent(&token, true, 0).expect("agreed");
    }
    let many = time(&mut study, 1000);
    // With every rater read anew it is some hundred times as long.
    assert!(many < 20 * few + std::time::Duration::from_millis(50), "{few:?}, then {many:?}");
}

/// Names of videos follow from nothing that others know.
#[test]
fn names_of_videos_cannot_be_guessed() {
    let names = |path: &std::path::Path| {
        let study = open(path, &document(Form::Relation, 3, 2, 2));
        study.addresses().map(|(name, _)| name.to_owned()).collect::<BTreeSet<_>>()
    };
    let [one, other] = [(); 2].map(|()| tempfile::tempdir().expect("a folder"));
    // The same after the server has been started again, and others for the same study elsewhere.
    let first = names(one.path());
    assert_eq!(first, names(one.path()));
    assert!(first.is_disjoint(&names(other.path())));
    assert!(first.iter().all(|name| name.len() == 32));
}

/// The jsPsych plugin has the same rule; its test reads the same cases.
#[test]
fn catch_trials_are_passed_as_in_the_plugin() {
    let cases = include_str!("../../../phase-web/jspsych/test/catch_trials.json");
    let cases: Vec<Value> = serde_json::from_str(cases).expect("JSON");
    assert!(cases.len() > 10);
    for case in cases {
        let form = Form::ALL.into_iter().find(|form| case["form"] == form.name()).expect("a form");
        let mut document = document(form, 6, 2, 3);
        document["catch_trials"] =
            json!([{"id": "catch-0", "video": "catch.mp4", "expected": case["expected"]}]);
        let questions = forms().questions(form, 2);
        let answer = Responses::read(&Field::root(&case["answer"]), &questions).expect("an answer");
        let given = GivenAnswer { at: 0, answer, response_time: 0, plays: 1 };
        let trial = Trial { shown: "catch-0".into(), catch: true, given: Some(given) };
        assert_eq!(trial.passed(&read(&document)), case["passed"].as_bool(), "{case}");
    }
}
