//! JSON is read in one way only, and what it says reaches no terminal as it is.

use phase_model::{
    foreign,
    json::{Field, JsonError, parse, parse_as, parse_text, shown},
};
use serde_json::{Value, json};
use std::collections::BTreeMap;

#[test]
fn everything_but_duplicates_is_read_as_by_the_library() {
    for text in [
        "null",
        " [1, -2, 3.5e-3, 18446744073709551615, -9223372036854775808, 0.1, 1e300]",
        r#"{"a": {"a": [true, false, null, "ü\n\u0041\ud83d\ude00"]}, "b": {"a": {}}, "": []}"#,
        "\u{feff}{}",
    ] {
        let plain = text.trim_start_matches('\u{feff}');
        assert_eq!(parse_text(text).expect("JSON"), serde_json::from_str::<Value>(plain).expect("JSON"));
    }
}

#[test]
fn an_object_has_every_member_once() {
    for (text, member, line) in [
        (r#"{"a": 1, "a": 1}"#, "a", 1),
        ("{\"a\": [{\"b\": 1},\n {\"c\": {\"b\": 2, \"d\": 3,\n \"b\": 4}}]}", "b", 3),
        (r#"{"\u0061": 1, "a": 2}"#, "a", 1),
        (r#"{"x at line 7": 1, "x at line 7": 2}"#, "x at line 7", 1),
    ] {
        let twice = JsonError::Twice { member: member.into(), line };
        assert_eq!(parse(text.as_bytes()), Err(twice), "{text}");
        let error = parse_as::<Value>(text).expect_err("refused").to_string();
        assert!(error.contains(member) && error.contains("twice"), "{error}");
        let map = parse_as::<BTreeMap<String, Value>>(text);
        assert!(map.is_err(), "{text}");
    }
    assert_eq!(parse_as::<BTreeMap<String, u8>>(r#"{"a": 1}"#).expect("JSON")["a"], 1);
    assert!(matches!(parse(br#"{"a": 1e999}"#), Err(JsonError::NumberTooLarge(1))));
    assert!(matches!(parse(br#"{"a": NaN}"#), Err(JsonError::NotANumber { .. })));
    assert!(matches!(parse(br#"{"a": "#), Err(JsonError::Truncated(1))));
}

#[test]
fn names_of_others_are_written_out_and_cut() {
    let evil = "\u{1b}]0;x\u{7}\u{9b}31m\u{202e}\u{2066}\n\r";
    let unseen =
        |text: &str| text.contains(|letter: char| letter.is_control() || "\u{202e}\u{2066}".contains(letter));
    assert!(!unseen(&foreign::name(evil)) && !unseen(&foreign::sentence(evil)));
    assert!(!unseen(&shown(&json!(evil))));
    assert_eq!(foreign::message("a\n\tb\u{1b}"), "a\n\tb\\u{1b}");
    assert_eq!(foreign::name("Größe (m²) 日本"), "Größe (m²) 日本");
    assert!(foreign::sentence(&"x".repeat(1 << 20)).len() < 2000);

    let value = json!({ "known": 1, evil: 2, "long": { "y".repeat(10_000): 3 } });
    let field = Field::root(&value);
    let said = field.only(&["known", "long"]).expect_err("unknown").to_string();
    assert!(!unseen(&said), "{said:?}");
    let said = field.required("long").expect("there").only(&[]).expect_err("unknown").to_string();
    assert!(said.len() < 300, "{said}");

    // The same value, for programs.
    let text = serde_json::to_string_pretty(&value).expect("JSON");
    let escaped = foreign::json(&text);
    assert!(!unseen(&escaped.replace('\n', "")), "{escaped:?}");
    assert_eq!(serde_json::from_str::<Value>(&escaped).expect("JSON"), value);
}
