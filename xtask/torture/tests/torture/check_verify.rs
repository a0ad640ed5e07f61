//! `check-verify`: what `verify` promises to find, it finds.

use crate::support::phase;
use serde_json::Value;

/// One edit of every kind. Those that make something genuine of the whole are found by the manifest's digest
/// alone.
#[test]
fn an_edit_of_every_kind_is_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let output =
        phase(folder.path()).args(["check-verify", "--edits", "44", "--seed", "5", "--json"]).output();
    let output = output.expect("the program starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let value: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(value["all"]["missed"], 0, "{value:#}");
    let rows = value["kinds"].as_array().expect("kinds");
    assert_eq!(rows.len(), 44);
    for row in rows {
        let genuine =
            ["date of publication", "other genuine dataset"].map(Value::from).contains(&row["kind"]);
        assert_eq!(row["found_by"]["--digest"], u64::from(genuine), "{row:#}");
    }
}
