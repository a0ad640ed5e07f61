//! `benchmark`, with agents that search little and short events.

use crate::{
    eval::{events_of, results},
    support::{refuse, succeed},
};
use phase_eval::benchmark::Benchmark;
use phase_report::evaluation;
use serde_json::{Value, json};
use std::{fs, path::Path};

/// Two test events: one in a layout and of a type that occur in the training data too, one in neither.
const PRESET: &str = r#"{
  "format": "phase-preset/3", "name": "tiny", "seed": 3,
  "layouts": {"seen": [0], "unseen": [6]},
  "selection": {"min_steps": 40, "max_steps": 100, "attempts": 200},
  "groups": [
    {"variant": "places", "split": "train", "layouts": "seen", "events": 1},
    {"variant": "places", "split": "test", "layouts": "seen", "events": 1},
    {"variant": "mixed", "split": "test", "layouts": "unseen", "events": 1}
  ]
}"#;
/// One minimal pair.
const PAIRS: &str = r#"{
  "format": "phase-preset/3", "name": "pairs", "seed": 3,
  "layouts": {"some": [0, 2, 6]},
  "selection": {"min_steps": 40, "max_steps": 50, "attempts": 400, "ends": "drawn"},
  "sets": [{"stances": ["hinder", "indifferent"], "about": "place", "split": "test", "layouts": "some", "sets": 1}]
}"#;
const PLAIN: &str = "chance,cue,still,constant-velocity";

/// A folder with the dataset `tiny` and the recordings `events.json`.
pub(crate) fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    fs::write(path.join("tiny.json"), PRESET).expect("written");
    let options = ["--simulations", "10", "--particles", "4", "--no-video", "--out", "tiny"];
    succeed(path, &[&["gen-dataset", "--preset", "tiny.json"], &options[..]].concat());
    events_of(path);
    folder
}

pub(crate) fn figures(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).expect("a benchmark")).expect("JSON")
}

/// The rows of a method, and the scores in each.
pub(crate) fn found<'a>(figures: &'a Value, task: &str, method: &str, what: &str) -> Vec<&'a Value> {
    let rows = figures[task].as_array().expect("rows").iter();
    rows.filter(|row| row["method"] == method).map(|row| row.pointer(what).expect("a figure")).collect()
}

#[test]
fn all_figures_are_those_of_eval() {
    let folder = folder();
    let path = folder.path();
    let benchmark = ["benchmark", "--data", "tiny", "--real", "events.json", "--methods", PLAIN];
    let told = succeed(path, &benchmark);
    assert!(told.contains("| SIMPLE | paper, Table 1 | 0.870 |"), "{told}");
    assert!(told.contains("| chance (ours) | generated (2) |"), "{told}");
    let figures = figures(&path.join("out/benchmark/benchmark.json"));
    assert_eq!(figures["format"], "phase-benchmark/1");
    for (task, method, of_eval, of_benchmark) in [
        ("goals", "cue", "/goal/top2", "/summary/all/top2/value"),
        ("goals", "cue", "/relation/accuracy", "/summary/all/relation/value"),
        ("trajectories", "still", "/fde/all", "/summary/all/fde/value"),
        ("trajectories", "constant-velocity", "/intervals/ade/all/1", "/summary/all/ade/high"),
    ] {
        let own: Vec<Value> = [&["--events", "tiny", "--split", "test"][..], &["--events", "events.json"]]
            .map(|events| {
                let options = [&["--method", method, "--out", "own", "--json", "own.json"], events].concat();
                succeed(path, &[&["eval", task], &options[..]].concat());
                fs::remove_dir_all(path.join("own")).expect("a folder");
                results(&path.join("own.json")).pointer(of_eval).expect("a figure").clone()
            })
            .to_vec();
        let found = found(&figures, task, method, of_benchmark);
        assert_eq!(found, own.iter().collect::<Vec<_>>(), "{task} {method} {of_eval}");
    }
    // Two events, one of each: the whole is the mean of its parts. Recordings are not divided.
    for task in ["goals", "trajectories"] {
        let method = if task == "goals" { "cue" } else { "still" };
        let figure = if task == "goals" { "/summary/all/top1/value" } else { "/summary/all/ade/value" };
        let [whole, _] = found(&figures, task, method, figure)[..] else { panic!("two sets") };
        let [parts, none] = found(&figures, task, method, "/parts")[..] else { panic!("two sets") };
        assert_eq!(none, &json!([]));
        let parts = parts.as_array().expect("parts");
        let names: Vec<&Value> = parts.iter().map(|part| &part["familiarity"]).collect();
        assert_eq!(names, ["seen-layout", "unseen-layout", "seen-interaction", "unseen-interaction"]);
        let of = |k: usize| parts[k].pointer(figure).and_then(Value::as_f64).expect("a figure");
        let whole = whole.as_f64().expect("a number");
        assert!((of(0) + of(1) - 2.0 * whole).abs() < 1e-9 && of(0) == of(2) && of(1) == of(3), "{parts:?}");
    }
    // Every correct goal is counted, on either set.
    let right = found(&figures, "goals", "cue", "/mistakes/right");
    let shares = found(&figures, "goals", "cue", "/summary/all/top1/value");
    let events = found(&figures, "goals", "cue", "/summary/all/n");
    for ((right, share), events) in right.into_iter().zip(shares).zip(events) {
        let [right, share, events] = [right, share, events].map(|number| number.as_f64().expect("a number"));
        assert!((right - 2.0 * events * share).abs() < 1e-9, "{right} of {events} events: {share}");
    }
    let report = fs::read_to_string(path.join("out/benchmark/report.md")).expect("a report");
    assert!(report.contains("## What goals were taken for"), "{report}");
    for file in ["report.md", "report.html", "goals.svg", "relations.svg", "ade.svg"] {
        assert!(path.join("out/benchmark").join(file).is_file(), "{file}");
    }
    // Finished evaluations are unchanged, and the report is overwritten.
    let before = fs::read(path.join("out/benchmark/benchmark.json")).expect("a file");
    succeed(path, &benchmark);
    assert!(fs::read(path.join("out/benchmark/benchmark.json")).expect("a file") == before);
}

#[test]
fn methods_from_outside_stand_beside_ours() {
    let folder = folder();
    let path = folder.path();
    let of = |events: &[&str]| {
        succeed(path, &[&["eval", "goals", "--method", "cue", "--json", "mine.json"], events].concat());
        let options = ["--predictions", "mine.json", "--out", "mine"];
        succeed(path, &[&["eval", "goals"], &options[..], events].concat());
    };
    let benchmark = |data: &str, results: &[&str]| -> Vec<String> {
        let options = ["benchmark", "--data", data, "--methods", "cue", "--results"];
        options.iter().chain(results).map(|&word| word.to_owned()).collect()
    };
    of(&["--events", "tiny", "--split", "test"]);
    let arguments = benchmark("tiny", &["mine/results.json"]);
    let told = succeed(path, &arguments.iter().map(String::as_str).collect::<Vec<_>>());
    assert!(told.contains("| mine (predictions) | generated (2) |"), "{told}");
    let figures = figures(&path.join("out/benchmark/benchmark.json"));
    let [ours, theirs] = ["cue", "mine"].map(|name| found(&figures, "goals", name, "/summary/all"));
    assert_eq!(ours, theirs);

    fs::remove_dir_all(path.join("mine")).expect("a folder");
    of(&["--events", "events.json"]);
    fs::write(path.join("none.json"), "{}").expect("written");
    for (data, file, rule) in [
        (
            "tiny",
            "mine/results.json",
            "mine/results.json: is not a complete results file: field `run.events_sha256` is not that",
        ),
        ("tiny", "none.json", "none.json: is not a complete results file: field `run.events_sha256`"),
        ("tiny", "missing.json", "missing.json: cannot be read: no such file"),
        (
            "events.json",
            "none.json",
            "events.json: is not a dataset with a manifest: --split needs a dataset",
        ),
        ("missing", "none.json", "missing: cannot be read"),
    ] {
        let arguments = benchmark(data, &[file]);
        let sentence = refuse(path, &arguments.iter().map(String::as_str).collect::<Vec<_>>());
        assert!(sentence.contains(rule), "{sentence}");
    }
    let sentence = refuse(path, &["benchmark", "--data", "tiny", "--pairs", "tiny", "--methods", "cue"]);
    assert!(sentence.contains("tiny: has no event with the field `set`"), "{sentence}");
    fs::create_dir(path.join("full")).expect("a folder");
    fs::write(path.join("full/thesis.tex"), "").expect("written");
    let sentence = refuse(path, &["benchmark", "--data", "tiny", "--methods", "cue", "--out", "full"]);
    assert!(sentence.contains("full: contains other files (thesis.tex)"), "{sentence}");
}

/// The figures for documents are those of the report; minimal pairs are asked of methods alone.
#[test]
fn figures_for_documents_make_the_results_page() {
    let folder = folder();
    let path = folder.path();
    fs::write(path.join("pairs.json"), PAIRS).expect("written");
    let options = ["--simulations", "10", "--particles", "4", "--no-video", "--out", "pairs"];
    succeed(path, &[&["gen-dataset", "--preset", "pairs.json"], &options[..]].concat());
    let measured = ["--data", "tiny", "--pairs", "pairs", "--methods", "cue,still"];
    succeed(path, &[&["benchmark", "--figures", "figures.json"], &measured[..]].concat());
    let shown = fs::read_to_string(path.join("figures.json")).expect("a file");
    let shown: Benchmark = serde_json::from_str(&shown).expect("a benchmark");
    let page = evaluation::page(&shown).expect("a page").text;
    let command =
        format!("cargo xtask-networks benchmark {} --figures data/results.json", measured.join(" "));
    assert!(page.lines().any(|line| line == command), "{page}");
    assert!(page.contains("## Minimal pairs") && !page.contains("## Agreement"), "{page}");
    let figures = figures(&path.join("figures.json"));
    assert_eq!(figures["options"], json!(measured));
    let labels: Vec<&Value> =
        figures["sets"].as_array().expect("sets").iter().map(|set| &set["label"]).collect();
    assert_eq!(labels, ["generated", "pairs"]);
    let top1 = found(&figures, "goals", "cue", "/summary/all/top1/value");
    assert_eq!((top1.len(), found(&figures, "trajectories", "still", "/set").len()), (2, 1));
    // What was seen in training is a question about the generated events alone.
    assert_eq!(found(&figures, "goals", "cue", "/parts")[1], &json!([]));
    for value in top1 {
        let value = value.as_f64().expect("a number");
        assert!(page.contains(&format!("| {value:.3} [")), "{value} in {page}");
    }
    let whole = fs::read_to_string(path.join("out/benchmark/benchmark.json")).expect("a file");
    let expected = evaluation::figures(&serde_json::from_str(&whole).expect("a benchmark"));
    let written = fs::read_to_string(path.join("figures.json")).expect("a file");
    assert!(written == evaluation::to_lines(&expected).expect("JSON") && written.len() < whole.len() / 2);
}

#[cfg(not(feature = "networks"))]
#[test]
fn networks_are_built_in_or_asked_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    for options in
        [&[][..], &["--methods", "cue,arg"], &["--methods", "cue", "--trained", "mine.safetensors"]]
    {
        let sentence = refuse(path, &[&["benchmark", "--data", "tiny"], options].concat());
        assert!(
            sentence.contains("`cargo install --path crates/phase-cli --features networks`"),
            "{sentence}"
        );
    }
    assert_eq!(fs::read_dir(path).expect("a folder").count(), 0);
}

#[test]
fn parts_of_a_benchmark_are_merged_to_the_figures_of_one_run() {
    let folder = folder();
    let path = folder.path();
    let benchmark =
        |more: &[&str]| succeed(path, &[&["benchmark", "--data", "tiny", "--methods", PLAIN], more].concat());
    benchmark(&["--evaluations", "one", "--out", "report-one"]);
    benchmark(&["--shard", "1/2", "--evaluations", "part1"]);
    benchmark(&["--shard", "2/2", "--evaluations", "part2"]);
    benchmark(&["--merge", "part1", "part2", "--evaluations", "merged", "--out", "report-merged"]);
    let evaluations = fs::read_dir(path.join("one")).expect("a folder").flatten();
    let mut compared = 0;
    for evaluation in evaluations {
        let file = |of: &str| fs::read(path.join(of).join(evaluation.file_name()).join("results.json"));
        assert!(file("one").expect("results") == file("merged").expect("results"), "{evaluation:?}");
        compared += 1;
    }
    assert_eq!(compared, 4);
    let scores = |report: &str| {
        let figures = figures(&path.join(report).join("benchmark.json"));
        found(&figures, "goals", "cue", "/summary/all").into_iter().cloned().collect::<Vec<_>>()
    };
    assert_eq!(scores("report-one"), scores("report-merged"));
}
