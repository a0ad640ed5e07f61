//! `torture`, as long as a test may take.
#![cfg(unix)]

use crate::support::{phase, succeed, text};

#[test]
fn nothing_is_lost_when_a_command_is_stopped() {
    let folder = tempfile::tempdir().expect("a folder");
    let table = succeed(folder.path(), &["torture", "--kills", "2", "--only", "merge", "--seed", "3"]);
    let row = table.lines().find(|line| line.starts_with("| merge |")).expect("a row");
    assert!(row.ends_with("| 2 | 2 | 2 | 2 | 2 | 2 |"), "{table}");
}

/// Whatever a program lacks is told, and no failure. A program that was built with networks lacks nothing.
#[test]
fn a_command_that_the_program_lacks_is_left_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let train = phase(folder.path()).args(["train", "arg", "--data", "nowhere", "--out", "x"]).output();
    let told = text(&train.expect("the program starts").stderr);
    if !told.contains("built without") {
        println!("skipped: this program has networks");
        return;
    }
    let output = phase(folder.path()).args(["torture", "--kills", "1", "--only", "train"]).output();
    let output = output.expect("the program starts");
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && told.contains("train: the program was built without it"), "{told}");
}

/// A fault that is asked for happens: otherwise nothing would be tested.
#[test]
fn faults_happen_at_their_step() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = |fault: &str| {
        let mut command = phase(folder.path());
        command.args(["new-scene", "--out", "scene.json"]).env("PHASE_FAULT", fault);
        command.output().expect("the program starts").status.code()
    };
    for step in 1..=3 {
        assert_eq!(scene(&format!("kill@{step}")), Some(137));
        assert!(!folder.path().join("scene.json").exists(), "stopped at step {step}");
        assert_eq!(scene(&format!("full@{step}")), Some(1));
        assert!(!folder.path().join("scene.json").exists(), "full at step {step}");
    }
    assert_eq!(scene("kill@4"), Some(137));
    assert!(folder.path().join("scene.json").exists(), "it has its name by then");
}
