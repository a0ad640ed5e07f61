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
    let wrong = ["invalid type: ", "invalid value: "].into_iter().find_map(|kind| message.strip_prefix(kind));
    match (field, wrong.and_then(|wrong| wrong.rsplit_once(", expected "))) {
        (Some(field), Some((found, rule))) => {
            format!("field `{field}` must be {}, not {}", expected(rule), shown(found))
        }
        (None, Some((found, rule))) => format!("must be {}, not {}", expected(rule), shown(found)),
        (Some(field), None) => format!("in `{field}`: {message}"),
        (None, None) => message.into(),
    }
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
