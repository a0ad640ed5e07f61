//! `torture`, as long as a test may take.
#![cfg(unix)]

use crate::support::{phase, succeed};

#[test]
fn nothing_is_lost_when_a_command_is_stopped() {
    let folder = tempfile::tempdir().expect("a folder");
    let table = succeed(folder.path(), &["torture", "--kills", "2", "--only", "merge", "--seed", "3"]);
    let row = table.lines().find(|line| line.starts_with("| merge |")).expect("a row");
    assert!(row.ends_with("| 2 | 2 | 2 | 2 | 2 | 2 |"), "{table}");
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
        assert_eq!(scene(&format!("full@{step}")), Some(2));
        assert!(!folder.path().join("scene.json").exists(), "full at step {step}");
    }
    assert_eq!(scene("kill@4"), Some(137));
    assert!(folder.path().join("scene.json").exists(), "it has its name by then");
}
