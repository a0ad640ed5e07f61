//! Whether programs and tests are built from the same packages with the same features.

use serde_json::Value;
use std::{
    collections::{BTreeMap, BTreeSet},
    process::Command,
};

/// What is compiled: package, target and mode.
type Unit = (String, String, String);

/// Packages from elsewhere that cargo would compile for these arguments, with the sets of features of each.
fn units(arguments: &[&str]) -> BTreeMap<Unit, BTreeSet<Vec<String>>> {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    // The graph is an unstable output of cargo; nothing is compiled.
    cargo.env("RUSTC_BOOTSTRAP", "1").args(arguments).args([
        "--locked",
        "--unit-graph",
        "-Zunstable-options",
    ]);
    let output = cargo.output().expect("cargo");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let graph: Value = serde_json::from_slice(&output.stdout).expect("a graph");
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let mut units = BTreeMap::new();
    for unit in graph["units"].as_array().expect("units") {
        let package = text(&unit["pkg_id"]);
        if package.starts_with("path+") {
            continue;
        }
        let features = unit["features"].as_array().expect("features").iter().map(text).collect();
        let name = (package, text(&unit["target"]["name"]), text(&unit["mode"]));
        units.entry(name).or_insert_with(BTreeSet::new).insert(features);
    }
    assert!(units.len() > 50);
    units
}

fn assert_same_features(program: &[&str]) {
    let tests = units(&["test", "--workspace", "--no-run"]);
    for (unit, features) in &units(program) {
        let Some(known) = tests.get(unit) else { continue };
        let other: Vec<_> = features.iter().filter(|features| !known.contains(*features)).collect();
        assert!(
            other.is_empty(),
            "{unit:?} has the features {other:?} for {program:?}, and {known:?} for the tests; \
             xtask/workspace-hack/Cargo.toml can ask for those that are missing"
        );
    }
}

#[test]
fn cargo_xtask_is_built_from_the_same_packages_as_the_tests() {
    assert_same_features(&["build", "--package", "xtask"]);
    assert_same_features(&["build", "--package", "xtask", "--features", "networks"]);
    assert_same_features(&["build", "--package", "xtask", "--features", "serve"]);
}

#[test]
fn the_python_package_is_built_from_the_same_packages_as_the_tests() {
    assert_same_features(&["build", "--package", "phase-python"]);
}

#[test]
fn packages_below_xtask_are_built_from_the_same_packages_as_the_tests() {
    for package in ["phase-fuzz", "phase-lab", "phase-torture"] {
        assert_same_features(&["build", "--package", package]);
    }
}
