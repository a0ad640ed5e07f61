//! From text to a JSON document.

use super::{JsonError, shown};
use serde_json::{Value, error::Category};

/// Parses UTF-8 bytes as JSON.
///
/// # Errors
/// [`JsonError::NotText`] and those of [`parse_text`].
pub fn parse(bytes: &[u8]) -> Result<Value, JsonError> {
    let text = std::str::from_utf8(bytes).map_err(|error| JsonError::NotText(error.valid_up_to()))?;
    parse_text(text)
}

/// Parses a text as JSON. A byte order mark at its start is skipped.
///
/// # Errors
/// [`JsonError::Empty`], [`JsonError::NotJson`], [`JsonError::Truncated`], [`JsonError::NotANumber`] or
/// [`JsonError::NumberTooLarge`].
pub fn parse_text(text: &str) -> Result<Value, JsonError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim().is_empty() {
        return Err(JsonError::Empty);
    }
    serde_json::from_str(text).map_err(|error| {
        let line = error.line();
        if error.classify() == Category::Eof {
            return JsonError::Truncated(line);
        }
        let what = error.to_string();
        if what.starts_with("number out of range") {
            return JsonError::NumberTooLarge(line);
        }
        match non_number(text, line, error.column()) {
            Some(token) => JsonError::NotANumber { token: token.into(), line },
            None => {
                JsonError::NotJson { what: what.split(" at line").next().unwrap_or_default().into(), line }
            }
        }
    })
}

/// Checks the member `format`, with which every JSON file of PHASE begins.
///
/// # Errors
/// [`JsonError::Format`].
pub fn check_format(document: &Value, expected: &'static str) -> Result<(), JsonError> {
    let found = match document {
        Value::Object(members) => match members.get("format") {
            Some(Value::String(format)) if format == expected => return Ok(()),
            Some(other) => format!("not {}", shown(other)),
            None => "and is missing".into(),
        },
        other => format!("but the file holds {} and no object", kind(other)),
    };
    Err(JsonError::Format { expected, found })
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "a truth value",
        Value::Number(_) => "a number",
        Value::String(_) => "a text",
        Value::Array(_) => "an array",
        Value::Object(_) => "an object",
    }
}

/// The spelling of a non-finite number near the position of a parse error. The parser reports the
/// position of the unexpected character or the one after it.
fn non_number(text: &str, line: usize, column: usize) -> Option<&'static str> {
    let line = text.lines().nth(line.checked_sub(1)?)?.as_bytes();
    let from = column.saturating_sub(4).min(line.len());
    let near = &line[from..line.len().min(column + 12)];
    ["-Infinity", "Infinity", "NaN", "-inf", "inf", "nan"].into_iter().find(|token| {
        near.windows(token.len()).position(|window| window == token.as_bytes()).is_some_and(|at| at <= 5)
    })
}
