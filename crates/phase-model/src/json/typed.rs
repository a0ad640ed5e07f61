//! From a JSON document to a value of a type that reads itself.

use crate::foreign;
use serde::de::{DeserializeOwned, Error as _};
use serde_json::Value;

/// Reads a value of a type from a JSON document. The error names the field, by its path, and its rule.
///
/// ```
/// use phase_model::json::read_as;
/// use serde_json::json;
///
/// let error = read_as::<Vec<[u8; 2]>>(json!([[1, 2], [3, 300]])).unwrap_err();
/// assert_eq!(error.to_string(), "field `[1][1]` must be a whole number from 0 to 255, not 300");
/// ```
///
/// # Errors
/// As [`serde_json::from_value`].
pub fn read_as<T: DeserializeOwned>(document: Value) -> Result<T, serde_json::Error> {
    serde_path_to_error::deserialize(document).map_err(|error| {
        let path = error.path().to_string();
        // The library writes a question mark for a name that it could not read, and a point for no path.
        let path = path.trim_end_matches('?').trim_end_matches('.');
        let field = (!path.is_empty()).then(|| foreign::name(path));
        serde_json::Error::custom(sentence(field.as_deref(), &error.inner().to_string()))
    })
}

/// The message of the library about a field, if it knows which, in the words of other messages.
fn sentence(field: Option<&str>, message: &str) -> String {
    let kinds = ["invalid type: ", "invalid value: ", "invalid length "];
    let wrong = kinds.into_iter().find_map(|kind| message.strip_prefix(kind));
    let Some((found, rule)) = wrong.and_then(|wrong| wrong.rsplit_once(", expected ")) else {
        return field.map_or_else(|| message.into(), |field| format!("in `{field}`: {message}"));
    };
    let prefix = field.map(|field| format!("field `{field}` ")).unwrap_or_default();
    let array = message.starts_with(kinds[2]).then(|| format!("an array of length {found}"));
    format!("{prefix}must be {}, not {}", expected(rule), array.as_deref().unwrap_or_else(|| shown(found)))
}

/// The rule behind a type of Rust.
fn expected(rule: &str) -> &str {
    match rule {
        "u8" => "a whole number from 0 to 255",
        "u16" => "a whole number from 0 to 65535",
        "u32" => "a whole number from 0 to 4294967295",
        "u64" | "usize" => "a whole number from 0 on",
        "i8" | "i16" | "i32" | "i64" | "isize" => "a whole number",
        "f32" | "f64" => "a number",
        "a boolean" => "true or false",
        "a string" | "a borrowed string" => "a text",
        "a sequence" => "an array",
        "a map" => "an object",
        "string or map" => "a text or an object",
        other if other.starts_with("struct ") => "an object",
        other => other,
    }
}

/// The value that was found, without its type, which shows.
fn shown(found: &str) -> &str {
    match found {
        "sequence" => return "an array",
        "map" => return "an object",
        _ => {}
    }
    let quoted = ["integer ", "floating point ", "boolean "].into_iter();
    let number = quoted.filter_map(|kind| found.strip_prefix(kind)).next();
    number.map_or_else(|| found.strip_prefix("string ").unwrap_or(found), |it| it.trim_matches('`'))
}

#[cfg(test)]
mod tests {
    use super::read_as;
    use serde::Deserialize;
    use serde_json::json;

    #[derive(Deserialize, Debug)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "only what cannot be read is looked at")]
    struct Thing {
        parts: Vec<[f32; 2]>,
        name: Option<String>,
        whole: Option<bool>,
    }

    #[test]
    fn errors_name_the_field_and_its_rule() {
        let cases = [
            (json!([]), "must be an object, not an array of length 0"),
            (json!("x"), "must be an object, not \"x\""),
            (json!({}), "missing field `parts`"),
            (json!({"parts": 3}), "field `parts` must be an array, not 3"),
            (
                json!({"parts": [[0.5, 1], [2]]}),
                "field `parts[1]` must be an array of length 2, not an array of length 1",
            ),
            (json!({"parts": [["a", 1]]}), "field `parts[0][0]` must be a number, not \"a\""),
            (json!({"parts": [], "name": {}}), "field `name` must be a text, not an object"),
            (json!({"parts": [], "whole": 0.5}), "field `whole` must be true or false, not 0.5"),
            (json!({"parts": [], "size": 1}), "in `size`: unknown field `size`, expected one of"),
        ];
        for (document, expected) in cases {
            let error = read_as::<Thing>(document).expect_err(expected).to_string();
            assert!(error.starts_with(expected), "{error} for {expected}");
        }
    }
}
