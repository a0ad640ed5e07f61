//! From text to a JSON document.

use super::{JsonError, read_as, shown};
use crate::foreign;
use core::fmt;
use serde::{
    Deserialize, Deserializer,
    de::{DeserializeOwned, Error as _, MapAccess, SeqAccess, Visitor},
};
use serde_json::{Map, Number, Value, error::Category, map::Entry};

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
/// [`JsonError::Empty`], [`JsonError::NotJson`], [`JsonError::Truncated`], [`JsonError::Twice`],
/// [`JsonError::NotANumber`] or [`JsonError::NumberTooLarge`].
pub fn parse_text(text: &str) -> Result<Value, JsonError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim().is_empty() {
        return Err(JsonError::Empty);
    }
    let Unambiguous(value) = serde_json::from_str(text).map_err(|error| {
        let line = error.line();
        if error.classify() == Category::Eof {
            return JsonError::Truncated(line);
        }
        let what = error.to_string();
        if error.classify() == Category::Data {
            let member = what.rsplit_once(" at line").map_or(&*what, |(member, _)| member).into();
            return JsonError::Twice { member, line };
        }
        if what.starts_with("number out of range") {
            return JsonError::NumberTooLarge(line);
        }
        match non_number(text, line, error.column()) {
            Some(token) => JsonError::NotANumber { token: token.into(), line },
            None => {
                JsonError::NotJson { what: what.split(" at line").next().unwrap_or_default().into(), line }
            }
        }
    })?;
    Ok(value)
}

/// Parses a line of a file of JSON lines; `number` is that of the line, from 1, which errors name.
///
/// # Errors
/// As [`parse`].
pub fn parse_line(line: &[u8], number: usize) -> Result<Value, JsonError> {
    parse(line).map_err(|error| match error {
        JsonError::NotJson { what, .. } => JsonError::NotJson { what, line: number },
        JsonError::Truncated(_) => JsonError::Truncated(number),
        JsonError::Twice { member, .. } => JsonError::Twice { member, line: number },
        JsonError::NotANumber { token, .. } => JsonError::NotANumber { token, line: number },
        JsonError::NumberTooLarge(_) => JsonError::NumberTooLarge(number),
        error => error,
    })
}

/// Parses a text as JSON of a type that reads itself. For texts whose members are all known to the type, and
/// for those of which it keeps some as they are.
///
/// # Errors
/// As [`serde_json::from_str`] and [`read_as`], and for an object with two members of one name.
pub fn parse_as<T: DeserializeOwned>(text: &str) -> Result<T, serde_json::Error> {
    let Unambiguous(value) = serde_json::from_str(text).map_err(|error| {
        if error.classify() == Category::Data {
            let what = error.to_string();
            let member = what.rsplit_once(" at line").map_or(&*what, |(member, _)| member);
            let (member, line) = (foreign::name(member), error.line());
            serde_json::Error::custom(format!("the member `{member}` comes twice, again in line {line}"))
        } else {
            error
        }
    })?;
    read_as(value)
}

/// JSON without objects that have two members of one name. Its only error of its own is the name of such a
/// member.
struct Unambiguous(Value);

impl<'de> Deserialize<'de> for Unambiguous {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(AnyValue).map(Self)
    }
}

struct AnyValue;

impl<'de> Visitor<'de> for AnyValue {
    type Value = Value;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("JSON")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(Number::from_f64(value).map_or(Value::Null, Value::Number))
    }

    fn visit_str<E>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_string<E>(self, value: String) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        let mut array = Vec::new();
        while let Some(Unambiguous(item)) = items.next_element()? {
            array.push(item);
        }
        Ok(array.into())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut members: A) -> Result<Value, A::Error> {
        let mut object = Map::new();
        while let Some(name) = members.next_key::<String>()? {
            match object.entry(name) {
                Entry::Occupied(there) => return Err(A::Error::custom(there.key())),
                Entry::Vacant(free) => {
                    let Unambiguous(value) = members.next_value()?;
                    free.insert(value);
                }
            }
        }
        Ok(object.into())
    }
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
