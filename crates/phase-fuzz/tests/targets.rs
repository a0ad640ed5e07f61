//! Every target, shortly: on its seeds, on inputs that once failed, and on mutations of both. `cargo xtask fuzz` runs them for longer.

use phase_fuzz::{fuzzing, targets};
use std::{cell::Cell, fs, path::Path};

/// Mutations of each target.
const MUTATIONS: u32 = 60;

/// The inputs kept in `corpus/<target>`.
fn corpus(target: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target);
    let Ok(files) = fs::read_dir(folder) else { return Vec::new() };
    files.map(|file| fs::read(file.expect("an entry").path()).expect("an input")).collect()
}

#[test]
fn no_target_fails() {
    for target in targets::TARGETS {
        let left = Cell::new(MUTATIONS);
        let goes_on = || {
            left.set(left.get().saturating_sub(1));
            left.get() > 0
        };
        let executions = fuzzing::run(target, corpus(target.0), 1, goes_on);
        let executions = executions.unwrap_or_else(|failure| panic!("{}: {}", target.0, failure.message));
        assert!(executions >= u64::from(MUTATIONS), "{}", target.0);
    }
}

#[test]
fn failures_are_found() {
    let input = vec![b'a'; 8];
    let failure = fuzzing::run(
        ("paths", |data| assert!(data.iter().all(u8::is_ascii), "not ASCII")),
        vec![input],
        1,
        || true,
    );
    let failure = failure.expect_err("mutations have other bytes");
    assert_eq!(failure.message, "not ASCII");
    assert!(!failure.input.is_ascii());
}
