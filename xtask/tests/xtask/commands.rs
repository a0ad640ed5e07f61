//! The commands of `phase`, as `cargo xtask` runs them.

use crate::support::{refuse, run, text};

#[test]
fn commands_and_chores_are_listed_under_this_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = run(folder.path(), &["--help"]);
    let help = text(&output.stdout);
    assert!(output.status.success() && help.contains("Usage: cargo xtask"), "{help}");
    for command in ["gen-dataset", "eval", "train", "results", "tidy"] {
        assert!(help.lines().any(|line| line.trim_start().starts_with(command)), "{command}: {help}");
    }
    let sentence = refuse(folder.path(), &["dance"]);
    assert!(sentence.contains("dance"), "{sentence}");
}

#[test]
fn a_command_of_phase_fails_as_there() {
    let folder = tempfile::tempdir().expect("a folder");
    assert!(refuse(folder.path(), &["verify", "nowhere"]).contains("nowhere: holds no manifest.json"));
}
