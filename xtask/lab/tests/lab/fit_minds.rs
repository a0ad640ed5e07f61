//! `fit-minds` on events of a few steps, with minds that search little.

use crate::support::{recording, refuse, run, succeed, text, tree, write_events};
use serde_json::{Value, json};
use std::{fs, path::Path};

/// Options with which an evaluation takes a moment.
const QUICK: [&str; 8] = ["--thin", "2", "--simulations", "5", "--rounds", "2", "--folds", "2"];

fn fit<'a>(more: &[&'a str]) -> Vec<&'a str> {
    let which = ["fit-minds", "--events", "events.json", "--only", "momentum_prior,horizon_steps"];
    [&which[..], &QUICK[..], more].concat()
}

/// A recording in which agent 1 walks this far in each step (u).
fn walking(id: &str, stride: f64) -> Value {
    let mut walking = recording(id);
    for (step, row) in walking["trajectory"]["agents"][1].as_array_mut().expect("rows").iter_mut().enumerate()
    {
        row[1] = json!(8.0 + stride * step as f64);
    }
    walking
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let events = [walking("a", 0.0), walking("b", 0.2), walking("c", 0.5)];
    write_events(&folder.path().join("events.json"), &events);
    fs::write(folder.path().join("minds.json"), r#"{"particles": 3}"#).expect("written");
    folder
}

fn json_of(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).expect("a file")).expect("JSON")
}

#[test]
fn a_fit_is_the_same_for_any_number_of_threads_and_after_an_interruption() {
    let folder = folder();
    let path = folder.path();
    let fitted = |jobs: &str, out: &str| {
        succeed(path, &fit(&["--parameters", "minds.json", "--jobs", jobs, "--out", out]))
    };
    let table = fitted("1", "one.json");
    assert_eq!(fitted("2", "two.json"), table);
    assert_eq!(json_of(&path.join("one.json")), json_of(&path.join("two.json")));
    assert_eq!(table.lines().filter(|line| line.starts_with("fold ")).count(), 2, "{table}");

    // As if it had been interrupted after a third of its evaluations, in the middle of a line.
    let kept = fs::read_to_string(path.join("one.evaluations.jsonl")).expect("evaluations");
    let lines = kept.lines().count();
    fs::write(path.join("three.evaluations.jsonl"), &kept[..kept.len() / 3]).expect("written");
    assert_eq!(fitted("2", "three.json"), table);
    assert_eq!(json_of(&path.join("one.json")), json_of(&path.join("three.json")));

    // Nothing is computed twice: not in one fit, and not by the same command again.
    let mut keys: Vec<Value> = kept.lines().map(|line| json_of_line(line)["key"].clone()).collect();
    keys.sort_by_key(Value::to_string);
    keys.dedup();
    assert_eq!(keys.len(), lines);
    assert_eq!(fitted("1", "one.json"), table);
    assert_eq!(fs::read_to_string(path.join("one.evaluations.jsonl")).expect("evaluations"), kept);

    // What is written can be read, and differs from the start in the parameters that were to be fitted alone.
    let fitted = json_of(&path.join("one.json"));
    assert_eq!(fitted["particles"], 3);
    succeed(
        path,
        &[
            "fit-minds",
            "--events",
            "events.json",
            "--parameters",
            "one.json",
            "--ablation",
            "--only",
            "turning",
        ],
    );
}

fn json_of_line(line: &str) -> Value {
    serde_json::from_str(line).expect("JSON")
}

#[test]
fn the_ablation_compares_each_parameter_with_its_neutral_value() {
    let folder = folder();
    let path = folder.path();
    // The momentum is neutral already: without it nothing changes.
    fs::write(path.join("minds.json"), r#"{"particles": 3, "momentum_prior": 1.0}"#).expect("written");
    let arguments = [
        &["fit-minds", "--events", "events.json", "--generated", "events.json", "--ablation"][..],
        &["--thin", "2", "--simulations", "5", "--parameters", "minds.json", "--out", "ablation.json"][..],
        &["--only", "momentum_prior,rest_prior"][..],
    ];
    let table = succeed(path, &arguments.concat());
    let ablation = json_of(&path.join("ablation.json"));
    assert_eq!(ablation["complete"]["events"], 6, "{table}");
    let [momentum, rest] = [&ablation["without"][0], &ablation["without"][1]];
    assert_eq!((&momentum["parameter"], &momentum["neutral"]), (&json!("momentum_prior"), &json!(1.0)));
    for figure in ["log_posterior", "log_likelihood", "chance"] {
        assert_eq!(momentum[figure]["mean"], 0.0, "{table}");
        let figure = |of: &Value, name: &str| of[name].as_f64().expect("a number");
        let expected = figure(&rest["means"], "chance") - figure(&ablation["complete"], "chance");
        assert!((figure(&rest["chance"], "mean") - expected).abs() < 1e-9);
    }
    // The posterior of one of 252 hypotheses, of which none is much likelier than another after two steps.
    let posterior = ablation["complete"]["log_posterior"].as_f64().expect("a number");
    assert!((-12.0..0.0).contains(&posterior), "{posterior}");
}

#[test]
fn rubbish_is_refused_in_one_sentence() {
    let folder = folder();
    let path = folder.path();
    fs::write(path.join("outside.json"), r#"{"momentum_prior": -1}"#).expect("written");
    fs::write(path.join("beyond.json"), r#"{"momentum_prior": 1e9}"#).expect("written");
    let before = tree(path);
    let cases: [(&[&str], &str); 9] = [
        (&["--only", "courage"], "courage"),
        (&["--folds", "4"], "fewer than --folds 4"),
        (&["--folds", "1"], "--folds"),
        (&["--thin", "0"], "--thin"),
        (&["--out", "events.json"], "--out events.json: is an input file"),
        (&["--out", "no/such/out.json"], "folder does not exist"),
        (
            &["--folds", "3", "--parameters", "outside.json"],
            "outside.json: field `momentum_prior` must be above 0, to 1000, not -1",
        ),
        (
            &["--folds", "3", "--parameters", "beyond.json"],
            "beyond.json: field `momentum_prior` must be above 0, to 1000, not 1000000000",
        ),
        (&["--folds", "3", "--generated", "missing.json"], "missing.json"),
    ];
    for (arguments, said) in cases {
        let sentence = refuse(path, &[&["fit-minds", "--events", "events.json"], arguments].concat());
        assert!(sentence.contains(said), "{sentence}");
    }
    assert_eq!(tree(path), before);
}

#[test]
fn progress_is_shown_from_the_start_unless_unwanted() {
    let folder = folder();
    let said = |more: &[&str]| text(&run(folder.path(), &fit(more)).stderr);
    let shown = said(&["--parameters", "minds.json"]);
    assert!(shown.starts_with("preparing 3 events\nround 1, momentum_prior: "), "{shown}");
    assert!(shown.contains("round 1  horizon_steps"), "{shown}");
    assert_eq!(said(&["--parameters", "minds.json", "--quiet"]), "");
}
