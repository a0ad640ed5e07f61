//! A run is known by what determines its results.

use phase_files::{
    folder::FolderError,
    run::{Run, canonical, digest},
};
use serde_json::{Value, json};
use std::path::Path;

/// Python writes the same for these values: `json.dumps(value, sort_keys=True, ensure_ascii=False,
/// separators=(",", ":"))`.
#[test]
fn the_canonical_form_is_sorted_and_short() {
    let value = json!({"b": [1, 0.1, 250.0, -0.5], "a": {"z": null, "é\n": "x\"y", "empty": {}}, "c": []});
    let text = r#"{"a":{"empty":{},"z":null,"é\n":"x\"y"},"b":[1,0.1,250.0,-0.5],"c":[]}"#;
    assert_eq!(canonical(&value), text);
    assert_eq!(serde_json::from_str::<Value>(text).expect("JSON"), value);
    // sha256sum of the two letters.
    assert_eq!(digest(&json!({})), "44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a");
}

#[test]
fn the_order_of_members_makes_no_difference_and_their_values_do() {
    let run = Run::new([("seed", 1.into()), ("command", "simulate".into())]);
    let held = Run::new([("command", "simulate".into()), ("seed", 1.into())]);
    let folder = Path::new("out");
    run.check(folder, "a finished", held.value()).expect("the same run");
    for (other, difference) in [
        (held.clone().with("seed", 2), "seed 2 instead of 1"),
        (held.clone().with("command", "eval").with("seed", 2), "command \"eval\" instead of \"simulate\""),
        (held.clone().with("videos", true), "videos true instead of null"),
    ] {
        let error = run.check(folder, "a finished", other.value()).expect_err(difference);
        assert!(
            error.to_string().contains(&format!("a finished run of another kind ({difference})")),
            "{error}"
        );
    }
}

#[test]
fn what_has_no_format_or_another_is_of_an_earlier_version() {
    let run = Run::new([("seed", 1.into())]);
    for held in [json!({"seed": 1}), json!({"seed": 1, "format": "phase-run/1"}), Value::Null, json!("text")]
    {
        let error = run.check(Path::new("out"), "a finished", &held).expect_err("of before");
        assert!(matches!(error, FolderError::EarlierRun(_)), "{error}");
    }
}
