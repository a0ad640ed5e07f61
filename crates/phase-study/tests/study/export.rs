//! Exports against the rules of Psych-DS and RFC 4180, and read back by what reads ratings.

use crate::support::{begin, complete, document, forms, open, parameters, random, some_answer, token_of};
use phase_eval::ratings::ratings as read_ratings;
use phase_study::{
    export::{File, psych_ds, ratings},
    forms::Form,
};
use serde_json::{Value, json};
use std::{
    collections::{BTreeMap, BTreeSet},
    path::Path,
};

/// The keywords of names of files that Psych-DS knows.
const KEYWORDS: [&str; 9] =
    ["study", "site", "subject", "session", "task", "condition", "trial", "stimulus", "description"];

/// The rows of a table, read by the rules of RFC 4180.
pub(crate) fn parse(text: &str) -> Vec<Vec<String>> {
    let (mut rows, mut row, mut cell) = (Vec::new(), Vec::new(), String::new());
    let (mut inside, mut letters) = (false, text.chars().peekable());
    while let Some(letter) = letters.next() {
        match letter {
            '"' if inside && letters.peek() == Some(&'"') => {
                letters.next();
                cell.push('"');
            }
            '"' => inside = !inside,
            ',' if !inside => row.push(std::mem::take(&mut cell)),
            '\n' if !inside => {
                row.push(std::mem::take(&mut cell));
                rows.push(std::mem::take(&mut row));
            }
            letter => cell.push(letter),
        }
    }
    assert!(!inside && row.is_empty() && cell.is_empty(), "the last line is ended");
    rows
}

/// Checks what the Psych-DS validator calls errors, and that no keyword is unofficial.
fn check(files: &[File]) {
    let by_path: BTreeMap<&str, &str> =
        files.iter().map(|file| (file.path.as_str(), file.text.as_str())).collect();
    assert!(by_path.values().all(|text| !text.is_empty()), "EMPTY_FILE");
    let description: Value = serde_json::from_str(by_path["dataset_description.json"]).expect("JSON");
    assert_eq!(description["@type"], "Dataset");
    assert_eq!(description["@context"], "http://schema.org/");
    for key in ["name", "description", "variableMeasured"] {
        assert!(!description[key].is_null(), "JSON_KEY_REQUIRED {key}");
    }
    let variables = description["variableMeasured"].as_array().expect("a list");
    assert!(variables.iter().all(|it| it["@type"] == "PropertyValue" && it["description"].is_string()));
    let measured: Vec<&str> = variables.iter().filter_map(|variable| variable["name"].as_str()).collect();
    let mut columns = BTreeSet::new();
    for (path, text) in by_path.iter().filter(|(path, _)| path.ends_with(".csv")) {
        let name =
            path.strip_prefix("data/").and_then(|it| it.strip_suffix("_data.csv")).expect("a data file");
        for pair in name.split('_') {
            let (key, value) = pair.split_once('-').expect("KEYWORD_FORMATTING_ERROR");
            assert!(KEYWORDS.contains(&key), "UNOFFICIAL_KEYWORD_WARNING {key}");
            assert!(!value.is_empty() && value.bytes().all(|it| it.is_ascii_alphanumeric()), "{value}");
        }
        let rows = parse(text);
        let head: BTreeSet<String> = rows[0].iter().cloned().collect();
        assert_eq!(head.len(), rows[0].len(), "CSV_HEADER_REPEATED");
        assert!(rows.iter().all(|row| row.len() == rows[0].len()), "CSV_HEADER_LENGTH_MISMATCH");
        columns.extend(head);
    }
    let named: BTreeSet<String> = measured.iter().map(|&name| name.to_owned()).collect();
    assert_eq!(named.len(), measured.len());
    assert_eq!(named, columns, "CSV_COLUMN_MISSING, CSV_COLUMN_MISSING_FROM_METADATA");
}

fn column(files: &[File], table: &str, name: &str) -> Vec<String> {
    let file = files.iter().find(|file| file.path.contains(table)).expect(table);
    let rows = parse(&file.text);
    let at = rows[0].iter().position(|head| head == name).expect(name);
    rows[1..].iter().map(|row| row[at].clone()).collect()
}

fn study(folder: &Path, form: Form) -> phase_study::study::Study {
    let mut document = document(form, 4, 3, 4);
    document["name"] = json!("experiment-1");
    document["stimuli"][2]["relation"] = json!("adversarial");
    document["stimuli"][2]["set"] = json!("pair-1");
    document["stimuli"][2]["condition"] = json!("hinder");
    document["stimuli"][2]["goals"] = json!([["touch", "help"], "none"]);
    document["raters"] = json!(50);
    document["raters_per_video_at_most"] = json!(50);
    document["demographics"] = json!([
        {"name": "age", "text": "How old are you?", "kind": "whole", "from": 18, "to": 120},
        {"name": "notes", "text": "Anything, \"else\"?", "kind": "text", "longest": 60},
    ]);
    let expected = if form == Form::Interactions {
        json!({"interactions": ["chasing"]})
    } else {
        json!({"relation": "neutral"})
    };
    document["catch_trials"] = json!([{"id": "catch-0", "video": "catch.mp4", "expected": expected}]);
    open(folder, &document)
}

#[test]
fn every_form_is_exported_by_the_rules() {
    for form in Form::ALL {
        let folder = tempfile::tempdir().expect("a folder");
        let mut study = study(folder.path(), form);
        let nobody = study_raters(&mut study);
        check(&psych_ds(study.config(), &forms(), &nobody, false));
        for k in 0..5_u64 {
            let id = format!("p{k}");
            complete(&mut study, &id, 1000 * k as i64, |page| some_answer(&page.questions, &mut random(k)));
        }
        let raters = study_raters(&mut study);
        for external in [false, true] {
            let files = psych_ds(study.config(), &forms(), &raters, external);
            check(&files);
            assert_eq!(files.iter().any(|file| file.text.contains("PROLIFIC_PID")), external);
            assert_eq!(column(&files, "answers", "rater").len(), 25);
            assert_eq!(column(&files, "raters", "rater"), ["1", "2", "3", "4", "5"]);
            let names = column(&files, "stimuli", "stimulus");
            assert_eq!(names, ["event-0", "event-1", "event-2", "event-3", "catch-0"]);
            assert_eq!(column(&files, "stimuli", "label_goal_0"), ["", "", "help; touch", "", ""]);
            assert_eq!(column(&files, "stimuli", "catch"), ["false", "false", "false", "false", "true"]);
            let shown = column(&files, "answers", "stimulus");
            for (name, wanted) in
                [("label_relation", "adversarial"), ("set", "pair-1"), ("condition", "hinder")]
            {
                for (shown, label) in shown.iter().zip(column(&files, "answers", name)) {
                    assert_eq!(label, if shown == "event-2" { wanted } else { "" });
                }
            }
            assert!(column(&files, "answers", "catch").iter().filter(|it| *it == "true").count() == 5);
        }
    }
}

fn study_raters(study: &mut phase_study::study::Study) -> Vec<phase_study::record::Rater> {
    study.raters().expect("raters")
}

#[test]
fn what_raters_write_is_data() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut study = study(folder.path(), Form::Relation);
    let texts = [
        "=HYPERLINK(\"https://evil.example\",\"x\")",
        "+1",
        "-1",
        "@SUM(A1)",
        " =1",
        "a,b \"c\" 'd'",
        "<script>alert(1)</script>",
        "％",
    ];
    for (k, text) in texts.iter().enumerate() {
        let joined = study.join(&parameters(&format!("={k}")), 0, token_of(k as u64)).expect("let in");
        study.consent(&joined.token, true, 0).expect("agreed");
        study.demographics(&joined.token, &json!({"age": 20, "notes": text}), 0).expect("said");
    }
    let raters = study_raters(&mut study);
    let files = psych_ds(study.config(), &forms(), &raters, true);
    check(&files);
    let notes = column(&files, "raters", "demographics_notes");
    for (text, note) in texts.iter().zip(&notes) {
        assert!(note == text || note == &format!("'{text}"), "{note}");
        assert!(!note.trim_start().starts_with(['=', '+', '-', '@']), "{note}");
    }
    assert!(column(&files, "raters", "external_PROLIFIC_PID").iter().all(|id| id.starts_with("'=")));
    assert!(column(&files, "raters", "demographics_age").iter().all(|age| age == "20"));
}

#[test]
fn ratings_are_those_of_raters_who_count() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut study = study(folder.path(), Form::Relation);
    // Two who count, one who fails the catch trial, one who withdraws, one who does not finish.
    let neutral = |_: &_| json!({"relation": "neutral"});
    complete(&mut study, "p1", 0, neutral);
    complete(&mut study, "p2", 0, neutral);
    complete(&mut study, "p3", 0, |_| json!({"relation": "friendly"}));
    let gone = complete(&mut study, "p4", 0, neutral).expect("done");
    study.withdraw(&gone, 9).expect("withdrawn");
    let token = study.join(&parameters("p5"), 0, token_of(5)).expect("let in").token;
    begin(&mut study, &token, 0);
    let raters = study_raters(&mut study);
    let counts =
        read_ratings(&ratings(study.config(), &raters).expect("relations")).expect("phase-ratings/1");
    assert_eq!(counts.len(), 4);
    for of in counts.values() {
        assert_eq!((of.friendly, of.neutral, of.adversarial), (0, 2, 0));
    }
    let files = psych_ds(study.config(), &forms(), &raters, false);
    assert_eq!(column(&files, "raters", "rater"), ["1", "2", "3", "5"]);
    assert_eq!(column(&files, "raters", "standing"), ["complete", "complete", "failed", "unfinished"]);
}

#[test]
fn interactions_have_no_ratings() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut study = study(folder.path(), Form::Interactions);
    let raters = study_raters(&mut study);
    assert_eq!(ratings(study.config(), &raters), None);
}
