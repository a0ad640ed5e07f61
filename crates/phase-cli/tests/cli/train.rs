//! `train`: its errors for invalid input, its files, and how it resumes after an interruption.

use crate::support::phase;
use serde_json::{Value, json};
use std::{
    fs,
    io::{BufRead, BufReader},
    path::Path,
    process::Stdio,
};

const NETWORKS: [&str; 7] =
    ["intent-network", "belief-network", "two-level-lstm", "arg", "socialgnn", "social-lstm", "stgat"];
/// One of them, for what is the same for all.
const NETWORK: &str = "two-level-lstm";
/// Rounds that a training goes on for.
const ROUNDS: &str = "3";

/// Exit code and stderr.
fn train(arguments: &[&str]) -> (Option<i32>, String) {
    let output = phase(Path::new(".")).arg("train").args(arguments).output().expect("the program starts");
    (output.status.code(), String::from_utf8(output.stderr).expect("text"))
}

#[test]
fn bad_input_is_one_sentence_and_exit_code_2() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (nothing, torn, empty, out) = (path("nothing"), path("torn"), path("empty"), path("out.safetensors"));
    for folder in [&torn, &empty] {
        fs::create_dir(folder).unwrap();
    }
    fs::write(path("torn/manifest.json"), "{\"format\": ").unwrap();
    let nowhere = path("nowhere/out.safetensors");
    let manifest = r#"{"format": "phase-dataset/1", "generator": "g", "preset": "p", "seed": 1, "settings": {},
        "selection": [], "events": [], "files": []}"#;
    fs::write(path("empty/manifest.json"), manifest).unwrap();
    let cases = [
        (
            &nothing,
            &out,
            format!("error: {nothing}: is not a finished dataset; give a folder with manifest.json\n"),
        ),
        (
            &torn,
            &out,
            format!("error: {torn}/manifest.json: is truncated: the JSON ends unfinished in line 1\n"),
        ),
        (
            &empty,
            &out,
            format!("error: {empty}: has no train events; datasets of the preset phase-500 have\n"),
        ),
        (
            &empty,
            &nowhere,
            format!("error: --out {nowhere}: cannot be written, for its folder does not exist\n"),
        ),
    ];
    for network in NETWORKS.into_iter().chain(["strength"]) {
        for (data, out, expected) in &cases {
            let (code, text) = train(&[network, "--data", data, "--out", out]);
            assert_eq!((code, &text), (Some(2), expected));
        }
    }
    let left: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left.len(), 2, "only the two datasets: {left:?}");
}

/// A dataset of three short events, one in each split.
fn write_dataset(folder: &Path) {
    let entries: Vec<Value> = ["train", "validation", "test"].into_iter().zip(0..).map(|(split, k)| {
        let way = |x: f64| (0..=4).map(|t| json!([x + 0.1 * f64::from(k * t), 8.0, 0.5, 0.0, 0.5])).collect();
        let (first, second): (Vec<Value>, Vec<Value>) = (way(9.0), way(20.0));
        let goal = |agent: u8| {
            json!({ "kind": "agent_on_landmark", "agent": agent, "landmark": agent, "sign": 1 })
        };
        let agent = |agent: u8| {
            json!({ "size_level": 0, "strength_level": 2, "alpha": 0, "goal": goal(agent) })
        };
        let outcome = |number: u8| {
            let mut entry = agent(number);
            entry["reached"] = json!(false);
            entry["steps_to_goal"] = Value::Null;
            entry
        };
        let event = json!({
            "id": split, "layout": { "base": 0, "flip": null }, "agents": [agent(0), agent(1)], "objects": [],
            "event": "independent",
            "trajectory": {
                "columns": ["x", "y", "vx", "vy", "angle"], "agents": [first, second], "objects": [],
            },
        });
        let file = json!({ "format": "phase-events/1", "events": [event] });
        fs::write(folder.join(format!("{split}.json")), file.to_string()).expect("written");
        let described = |name: String| json!({ "path": name, "bytes": 0, "sha256": "0".repeat(64) });
        json!({
            "id": split, "kind": "independent", "split": split, "relation": "neutral", "seed": 1,
            "layout": { "base": 0, "flip": null }, "agents": [outcome(0), outcome(1)],
            "object_size_levels": [], "steps": 4, "event": described(format!("{split}.json")),
            "video": described(format!("{split}.mp4")),
        })
    }).collect();
    let manifest = json!({
        "format": "phase-dataset/1", "generator": "g", "preset": "p", "seed": 1, "settings": {},
        "selection": [], "events": entries, "files": [],
    });
    fs::write(folder.join("manifest.json"), manifest.to_string()).expect("written");
}

/// A record without its times, which differ between trainings.
fn timeless(file: &str) -> Value {
    let mut record: Value = serde_json::from_slice(&fs::read(file).expect("a record")).expect("JSON");
    for field in ["cpu_seconds", "seconds"] {
        assert!(record[field].take().as_f64() > Some(0.0));
        let rounds = record["rounds"].as_array_mut().expect("rounds");
        rounds.iter_mut().for_each(|round| round[field] = Value::Null);
    }
    record
}

#[test]
fn a_training_that_was_broken_off_goes_on_to_the_same_weights() {
    let folder = tempfile::tempdir().unwrap();
    write_dataset(folder.path());
    let results = tempfile::tempdir().expect("a folder");
    let path = |name: &str| results.path().join(name).to_string_lossy().into_owned();
    let (data, straight, broken) = (folder.path().to_string_lossy(), path("straight"), path("broken"));
    let options = |out| [NETWORK, "--data", &data, "--out", out, "--rounds", ROUNDS];
    let (code, said) = train(&options(&straight));
    assert_eq!(code, Some(0), "{said}");
    let mut child = phase(Path::new("."))
        .arg("train")
        .args(options(&broken))
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The first checkpoint is written before its round is reported; what is read and the head come before it.
    let told = BufReader::new(child.stderr.take().unwrap()).lines().take(6).count();
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(told, 6);
    let checkpoint = format!("{broken}.checkpoint");
    let (code, text) = train(&[&options(&broken)[..], &["--seed", "2"]].concat());
    let reason = "belongs to a training with another seed; give the options of that training, choose another \
        file or remove this one";
    let read = "reading train events\n1/1 train\nreading validation events\n1/1 validation\n";
    assert_eq!((code, text), (Some(2), format!("{read}error: {checkpoint}: {reason}\n")));
    let (code, said) = train(&options(&broken));
    assert!(code == Some(0) && said.contains("continuing after round "), "{said}");
    assert!(fs::read(&straight).unwrap() == fs::read(&broken).unwrap());
    let record = timeless(&format!("{straight}.training.json"));
    assert_eq!(record, timeless(&format!("{broken}.training.json")));
    assert_eq!(record["rounds"].as_array().unwrap().len().to_string(), ROUNDS);
    assert_eq!(record["data"], record["validation"]);
    assert!(record["final"]["train"]["loss"].is_number(), "{record}");
    assert!(!Path::new(&checkpoint).exists());
}

#[test]
fn the_record_says_what_was_learnt_from() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    for name in ["first", "second"] {
        fs::create_dir(path(name)).unwrap();
        write_dataset(Path::new(&path(name)));
    }
    // Another dataset for validation.
    let changed = path("second/manifest.json");
    let manifest = fs::read_to_string(&changed).unwrap().replace(&"0".repeat(64), &"1".repeat(64));
    fs::write(&changed, manifest).unwrap();
    let (first, second, out) = (path("first"), path("second/../second/"), path("out"));
    let options = [NETWORK, "--data", &first, "--validation", &second, "--out", &out, "--rounds", "1"];
    let (code, said) = train(&[&options[..], &["--events", "1", "--test"]].concat());
    assert_eq!(code, Some(0), "{said}");
    let record = timeless(&format!("{out}.training.json"));
    assert!(record["final"]["test"]["scores"]["relation"].is_number(), "{record}");
    let (data, validation) = (&record["data"], &record["validation"]);
    assert_eq!((&data["folder"], &data["events"]), (&json!("first"), &json!(1)));
    assert_eq!((&validation["folder"], &validation["events"]), (&json!("second"), &json!(1)));
    assert_ne!(data["sha256"], validation["sha256"]);
    for command in [NETWORK, "strength"] {
        let (code, text) = train(&[command, "--data", &first, "--out", &out, "--events", "2"]);
        let reason = "has 1 train events, fewer than the 2 of --events";
        assert_eq!((code, text), (Some(2), format!("error: {first}: {reason}\n")));
    }
}

#[test]
fn beliefs_are_learnt_from_simulated_events_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    write_dataset(folder.path());
    let results = tempfile::tempdir().expect("a folder");
    let out = results.path().join("out").to_string_lossy().into_owned();
    let data = folder.path().to_string_lossy();
    let (code, said) = train(&["belief-network", "--data", &data, "--out", &out]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("event train: was not simulated"), "{said}");
    assert!(!Path::new(&out).exists());
    let inside = folder.path().join("out").to_string_lossy().into_owned();
    let (code, said) = train(&["belief-network", "--data", &data, "--out", &inside]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("would lie in the dataset"), "{said}");
}

/// Further training events come from datasets and from simulations, and are in the record; what was trained
/// can be used.
#[test]
fn further_training_events() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    for name in ["first", "second"] {
        fs::create_dir(path(name)).unwrap();
        write_dataset(Path::new(&path(name)));
    }
    let (first, second, out) = (path("first"), path("second"), path("out"));
    let options = ["intent-network", "--data", &first, "--out", &out, "--rounds", "2"];
    let (code, said) = train(&[&options[..], &["--more", &second, &first]].concat());
    assert_eq!(code, Some(0), "{said}");
    let record = timeless(&format!("{out}.training.json"));
    let more = record["more"].as_array().expect("further data");
    let named: Vec<(&Value, &Value)> =
        more.iter().map(|source| (&source["folder"], &source["events"])).collect();
    assert_eq!(named, [(&json!("second"), &json!(1)), (&json!("first"), &json!(1))]);
    let (code, text) = train(&[&options[..], &["--more", &path("nothing")]].concat());
    assert_eq!(code, Some(2), "{text}");
    assert!(text.contains("nothing: is not a finished dataset"), "{text}");

    let events = path("first/test.json");
    let evaluate = |weights: &str| {
        let arguments =
            ["eval", "goals", "--method", "intent-network", "--events", &events, "--json", "--quiet"];
        let mut command = phase(folder.path());
        command.args(arguments).args(["--weights", weights, "--out", &path("evaluated")]);
        command.output().expect("the program starts")
    };
    let output = evaluate(&out);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let results: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert!(results["relation"]["accuracy"].is_number(), "{results}");
    let output = evaluate(&events);
    assert_eq!(output.status.code(), Some(2));
    let sentence = String::from_utf8(output.stderr).expect("text");
    assert!(sentence.contains("test.json: is not a complete file of weights"), "{sentence}");
}
