//! Selected datasets: attempts, resuming between them, shards, splits and figures.

use crate::support::{fail, phase, refuse, run, succeed, text, tree};
use phase_dataset::manifest::Manifest;
use std::{
    fs,
    io::{BufRead, BufReader},
    path::Path,
    process::{Command, Stdio},
};

/// Five events of agents that search little; the first scenes often fail.
const PRESET: &str = r#"{
  "format": "phase-preset/3", "name": "tiny", "seed": 3,
  "layouts": {"open": [0, 2, 6]},
  "selection": {"min_steps": 40, "max_steps": 100, "attempts": 200},
  "groups": [
    {"variant": "places", "split": "train", "layouts": "open", "events": 2},
    {"variant": "lift", "split": "validation", "layouts": "open", "events": 1},
    {"variant": "hinder-place", "split": "test", "layouts": "open", "events": 2}
  ]
}"#;

fn generate<'a>(out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let options = ["gen-dataset", "--preset", "tiny.json", "--simulations", "10", "--particles", "4"];
    [&options[..], &["--out", out], more].concat()
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("tiny.json"), PRESET).expect("written");
    folder
}

#[test]
fn shards_interruptions_and_jobs_leave_no_trace() {
    let folder = folder();
    let path = folder.path();
    let told = succeed(path, &generate("whole", &[]));
    assert!(told.contains("| independent | places | 2 |"), "{told}");
    let whole = tree(&path.join("whole"));

    for shard in ["1/2", "2/2"] {
        succeed(path, &generate(&format!("shard{}", &shard[..1]), &["--shard", shard]));
    }
    let told = succeed(path, &generate("shard1", &["--shard", "1/2"]));
    assert!(told.contains("holds this shard already; all 3 events"), "{told}");
    let sentence = refuse(path, &generate("shard1", &["--shard", "2/2"]));
    assert!(sentence.contains("shard \"1/2\" instead of \"2/2\""), "{sentence}");
    succeed(path, &["merge", "shard2", "shard1", "--out", "merged"]);
    assert!(tree(&path.join("merged")) == whole, "merged shards differ from one run");

    // Stopped after its first event, at any attempt.
    let mut child = phase(path)
        .args(generate("stopped", &["--jobs", "1"]))
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let stderr = child.stderr.take().expect("a pipe");
    BufReader::new(stderr).lines().nth(1).expect("a line").expect("text");
    Command::new("kill").args(["-KILL", &child.id().to_string()]).status().expect("kill runs");
    child.wait().expect("it ends");
    assert!(!path.join("stopped/manifest.json").exists());
    let resumed = run(path, &generate("stopped", &["--jobs", "2"]));
    assert!(resumed.status.success(), "{}", text(&resumed.stderr));
    assert!(text(&resumed.stderr).contains("(kept)"), "{}", text(&resumed.stderr));
    assert!(tree(&path.join("stopped")) == whole, "the resumed run differs");

    check_merge_refusals(path);
    check_descriptions(path);
}

fn check_merge_refusals(path: &Path) {
    let cases: [(&[&str], &str); 4] = [
        (&["shard1"], "shard 2 of 2 is missing"),
        (&["shard1", "shard2", "shard1"], "are both shard 1"),
        (&["shard1", "whole"], "holds no finished shard"),
        (&["shard1", "nowhere"], "no such file"),
    ];
    for (shards, part) in cases {
        let sentence = refuse(path, &[&["merge"], shards, &["--out", "nothing"]].concat());
        assert!(sentence.contains(part), "{sentence}");
    }
    assert!(!path.join("nothing").exists());
    // The very dataset is there already.
    let before = tree(&path.join("whole"));
    let told = succeed(path, &["merge", "shard1", "shard2", "--out", "whole"]);
    assert!(told.contains("holds this dataset already") && tree(&path.join("whole")) == before);
    fs::write(path.join("shard2/events/tiny-0001.json"), "rubbish").expect("written");
    let sentence = fail(path, &["merge", "shard1", "shard2", "--out", "spoilt"]);
    assert!(sentence.contains("shard2/events/tiny-0001.json: differs in size"), "{sentence}");
}

fn check_descriptions(path: &Path) {
    let manifest = Manifest::read(&path.join("whole/manifest.json")).expect("a manifest");
    assert_eq!(manifest.selection.iter().map(|row| row.events).sum::<usize>(), 5);
    assert!(manifest.events.iter().all(|event| event.steps >= 40 && event.split.is_some()));
    let told = succeed(path, &["stats", "whole", "--out", "figures"]);
    assert!(told.contains("| videos | 500 | 5 |") && told.contains("| validation | 80 | 1 |"), "{told}");
    assert!(fs::read_to_string(path.join("figures/goals.svg")).expect("a plot").contains("<svg"));
    // Five events cannot satisfy the rules for test events; the sizes would be 3, 1, 1.
    let sentence = run(path, &["splits", "whole"]);
    assert_eq!(sentence.status.code(), Some(2));
    assert!(text(&sentence.stdout).contains("| train | 3 | 2 | broken |"), "{}", text(&sentence.stdout));
    let made = run(path, &["splits", "whole", "--make", "split.json"]);
    assert!(text(&made.stdout).contains("| train | 3 | 3 | met |"), "{}", text(&made.stdout));
    let again = run(path, &["splits", "whole", "--splits", "split.json"]);
    assert!(text(&again.stdout).contains("| test | 1 | 1 | met |"), "{}", text(&again.stdout));
    fs::write(
        path.join("split.json"),
        fs::read_to_string(path.join("split.json")).expect("text").replace("tiny-0002", "tiny-0009"),
    )
    .expect("written");
    let sentence = refuse(path, &["splits", "whole", "--splits", "split.json"]);
    assert!(sentence.contains("tiny-0002") && sentence.contains("in no part"), "{sentence}");
}

#[test]
fn a_slot_that_nothing_fits_ends_the_run_and_says_why() {
    let folder = folder();
    let path = folder.path();
    let hopeless = PRESET.replace("\"min_steps\": 40", "\"min_steps\": 99").replace("200}", "2}");
    fs::write(path.join("tiny.json"), hopeless).expect("written");
    let output = run(path, &generate("out", &["--max-steps", "50"]));
    let sentence = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{sentence}");
    assert!(sentence.contains("tiny-0000") && sentence.contains("too-short 2"), "{sentence}");
    let shard = refuse(path, &["gen-dataset", "--shard", "5/4"]);
    assert!(shard.contains("K/N"), "{shard}");
}
