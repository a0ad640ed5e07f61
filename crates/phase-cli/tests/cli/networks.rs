//! `eval` and `train` with the neural baselines, in a program with and without them.

#[cfg(feature = "networks")]
use crate::{
    benchmark::{figures, folder, found},
    eval::results,
    support::succeed,
};
use crate::{
    eval::moving,
    support::{refuse, write_events},
};
use serde_json::Value;
use std::{fs, path::Path};

/// The networks with their tasks.
const NETWORKS: [(&str, &str); 5] = [
    ("goals", "two-level-lstm"),
    ("goals", "arg"),
    ("goals", "socialgnn"),
    ("trajectories", "social-lstm"),
    ("trajectories", "stgat"),
];

fn events_of(path: &Path) {
    let events: Vec<Value> = (0..3).map(|k| moving(&format!("event-{k}"), 24 + 9 * k)).collect();
    write_events(&path.join("events.json"), &events);
}

#[cfg(not(feature = "networks"))]
#[test]
fn a_program_without_networks_says_how_to_get_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    for (task, name) in NETWORKS {
        let sentence = refuse(path, &["eval", task, "--method", name, "--events", "events.json"]);
        assert!(
            sentence.contains("`cargo install --path crates/phase-cli --features networks`"),
            "{sentence}"
        );
        let questions = ["questions", "events.json", "--answers", name, "--out", "out"];
        assert!(
            refuse(path, &questions).contains("`cargo install --path crates/phase-cli --features networks`")
        );
        let train = ["train", name, "--data", "nowhere", "--out", "out"];
        assert!(refuse(path, &train).contains("`cargo install --path crates/phase-cli --features networks`"));
    }
    assert!(results_missing(path));
}

#[cfg(not(feature = "networks"))]
fn results_missing(path: &Path) -> bool {
    // Nothing was begun.
    !path.join("out").exists() && fs::read_dir(path).expect("a folder").count() == 1
}

#[cfg(feature = "networks")]
#[test]
fn answers_do_not_depend_on_threads() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    for (task, name) in NETWORKS {
        let [one, two] = ["1", "2"].map(|jobs| {
            let out = format!("{name}-{jobs}");
            let options = ["--events", "events.json", "--jobs", jobs, "--out", &out];
            succeed(path, &[&["eval", task, "--method", name], &options[..]].concat());
            results(&path.join(out).join("results.json"))
        });
        assert_eq!(one, two);
        let event = &one["events"][2];
        if task == "goals" {
            // One object: four own landmark goals, eight of the other's, eight of the object, two of
            // touching; a method that says nothing of goals has the agent's own, all equally likely.
            let goals = event["goals"][1].as_array().expect("goals");
            assert_eq!(goals.len(), if name == "socialgnn" { 10 } else { 22 });
            let sum: f64 = goals.iter().map(|share| share["p"].as_f64().expect("a number")).sum();
            assert!((sum - 1.0).abs() < 1e-6, "{sum}");
        } else {
            let steps = event["forecast"][2].as_array().expect("steps");
            assert_eq!((event["forecast"].as_array().expect("entities").len(), steps.len()), (3, 20));
        }
        let sha256 = &one["run"]["method_settings"]["method"]["weights_sha256"];
        assert_eq!(sha256.as_str().expect("a checksum").len(), 64);
    }
}

/// The bundled weights.
#[cfg(feature = "networks")]
fn bundled(name: &str) -> String {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data");
    data.join(format!("{name}.safetensors")).to_string_lossy().into_owned()
}

/// Weights from a file give the same results as the bundled ones, and both have the same training curves.
#[cfg(feature = "networks")]
#[test]
fn networks_in_the_benchmark() {
    let folder = folder();
    let path = folder.path();
    let [arg, stgat] = ["arg", "stgat"].map(|name| {
        let copy = path.join(format!("copy-of-{name}.safetensors"));
        fs::copy(bundled(name), &copy).expect("copied");
        copy.to_string_lossy().into_owned()
    });
    let arguments = ["benchmark", "--data", "tiny", "--methods", "arg,stgat", "--trained", &arg, &stgat];
    let sentence = refuse(path, &arguments);
    assert!(sentence.contains("copy-of-arg.safetensors.training.json: cannot be read"), "{sentence}");
    for (name, copy) in [("arg", &arg), ("stgat", &stgat)] {
        fs::copy(format!("{}.training.json", bundled(name)), format!("{copy}.training.json"))
            .expect("copied");
    }
    succeed(path, &arguments);
    let figures = figures(&path.join("out/benchmark/benchmark.json"));
    for (task, name, what) in [
        ("goals", "arg", "/summary/all"),
        ("trajectories", "stgat", "/summary/all"),
        ("goals", "arg", "/training"),
    ] {
        let copies = found(&figures, task, &format!("copy-of-{name}"), what);
        assert_eq!((found(&figures, task, name, what), copies.len()), (copies, 1), "{name} {what}");
    }
    assert_eq!(figures["trainings"].as_array().map(Vec::len), Some(2));
    assert_eq!(figures["trainings"][0]["events"], 320);
    fs::write(format!("{arg}.training.json"), "{\"format\": \"phase-training/1\"}").expect("written");
    let sentence = refuse(path, &arguments);
    assert!(sentence.contains("training.json: is not a training record: missing field"), "{sentence}");
}

#[cfg(feature = "networks")]
#[test]
fn weights_of_ones_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    fs::write(path.join("rubbish"), "rubbish").expect("written");
    for (task, name) in NETWORKS {
        let with = |weights: &str| {
            let options = ["--events", "events.json", "--weights", weights, "--out", name];
            [&["eval", task, "--method", name], &options[..]].concat().into_iter().map(String::from).collect()
        };
        let refused = |weights: &str| {
            let arguments: Vec<String> = with(weights);
            refuse(path, &arguments.iter().map(String::as_str).collect::<Vec<_>>())
        };
        assert!(refused("missing").contains("missing: cannot be read: no such file"));
        assert!(refused("rubbish").contains("rubbish: is not a complete file of weights"));
        let other = if name == "arg" { "stgat" } else { "arg" };
        let sentence = refused(&bundled(other));
        assert!(sentence.contains(&format!("field `format` must be \"phase-{name}/1\"")), "{sentence}");
        let arguments: Vec<String> = with(&bundled(name));
        succeed(path, &arguments.iter().map(String::as_str).collect::<Vec<_>>());
        // The bundled ones are the same.
        let common = ["--events", "events.json", "--out", name];
        let told = succeed(path, &[&["eval", task, "--method", name], &common[..]].concat());
        assert!(told.contains("holds this evaluation already"), "{told}");
    }
}
