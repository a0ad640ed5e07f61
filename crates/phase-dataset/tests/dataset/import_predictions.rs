//! Answers of networks that were published beside the recordings.

use crate::import_socialgnn::{assert_refused, import, json_of, made_up, python};
use serde_json::json;

/// Each file of a network's answers is a rater; the right answers before them are not read.
#[test]
fn published_predictions_are_counted() {
    let Some(folder) = made_up() else { return };
    let folder = folder.path();
    let script = r#"
import pickle
names = [entry["name"] for entry in pickle.load(open("recordings.pkl", "rb")) if entry]
def keep(file, *contents):
    with open(file, "wb") as stream:
        for content in contents:
            pickle.dump(content, stream)
right = dict.fromkeys(names, "friendly")
keep("first", right, {names[0]: "neutral", names[1]: "adversarial", "elsewhere.mp4": "friendly"})
keep("second", right, {names[0]: "adversarial"})
keep("one", right)
keep("mood", right, {names[0]: "angry"})
keep("list", right, [names[0]])
keep("other", right, {"elsewhere.mp4": "friendly"})
"#;
    assert!(python(folder, script).expect("python3").status.success());
    let given = |files: &[&str]| {
        let before = ["recordings.pkl", "out.json", "--predicted", "predicted.json", "--predictions"];
        let arguments: Vec<String> = before.iter().chain(files).map(|&it| it.to_owned()).collect();
        arguments
    };
    for (file, wanted) in [
        ("one", "one: is no pickle of plain data"),
        ("mood", "mood: must hold the relations friendly, neutral, adversarial, not angry"),
        ("list", "list: must hold answers to 1 to 1000 videos"),
        ("other", "other: has no answers about these recordings"),
        ("missing", "missing: cannot be read"),
    ] {
        let arguments = given(&["first", file]);
        assert_refused(folder, &arguments.iter().map(String::as_str).collect::<Vec<_>>(), wanted);
        assert!(!folder.join("predicted.json").exists());
    }
    let arguments = given(&["first", "second"]);
    let output = import(folder, &arguments.iter().map(String::as_str).collect::<Vec<_>>());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let wanted = json!({
        "format": "phase-ratings/1",
        "ratings": {
            "phase-test-000": { "friendly": 0, "neutral": 1, "adversarial": 1 },
            "phase-test-002": { "friendly": 0, "neutral": 0, "adversarial": 1 },
        },
    });
    assert_eq!(json_of(&folder.join("predicted.json")), wanted);
}

/// The published SIMPLE's probabilities become a table for dissimilarity matrices; clips have names that end
/// otherwise.
#[test]
fn published_posteriors_become_a_table() {
    let Some(folder) = made_up() else { return };
    let folder = folder.path();
    let script = r#"
import pickle
names = [entry["name"] for entry in pickle.load(open("recordings.pkl", "rb")) if entry]
def keep(file, content):
    with open(file, "wb") as stream:
        pickle.dump(content, stream)
        pickle.dump("goals, which are not read", stream)
even = [("friendly", 0.5), ("neutral", 0.25), ("adversarial", 0.25)]
keep("sound", {"videos/" + names[0]: even, names[1]: [("neutral", 1.0)], "elsewhere.mp4": even})
keep("clips", {names[0][:30] + "_10s.mp4": even})
keep("vague", {names[1][:30] + "_10s.mp4": even})
keep("odd", {names[0]: [("friendly", 0.5)]})
keep("twice", {names[0]: [("friendly", 0.5), ("friendly", 0.5)]})
keep("mood", {names[0]: [("angry", 1.0)]})
keep("flat", {names[0]: ["friendly"]})
keep("list", [even])
keep("other", {"elsewhere.mp4": even})
"#;
    assert!(python(folder, script).expect("python3").status.success());
    let given =
        |file: &'static str| ["recordings.pkl", "out.json", "--posterior", file, "--table", "table.csv"];
    for (file, wanted) in [
        ("odd", "that add up to 1"),
        ("twice", "that add up to 1"),
        ("mood", "must have probabilities of friendly, neutral, adversarial"),
        ("flat", "must have probabilities"),
        ("list", "must begin with the relations of"),
        ("other", "other: has no answers about these recordings"),
        ("vague", "vague: has no answers about these recordings"),
    ] {
        assert_refused(folder, &given(file), wanted);
        assert!(!folder.join("table.csv").exists());
    }
    let table = |file| {
        let output = import(folder, &given(file));
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        std::fs::read_to_string(folder.join("table.csv")).expect("a table")
    };
    let head = "id,relation_friendly,relation_neutral,relation_adversarial\n";
    let first = "phase-test-000,0.500000,0.250000,0.250000\n";
    let rows = "phase-test-002,0.000000,1.000000,0.000000\n";
    assert_eq!(table("sound"), [head, first, rows].concat());
    assert_eq!(table("clips").lines().count(), 2);
}
