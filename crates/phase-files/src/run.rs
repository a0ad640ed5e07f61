//! Identity of runs: everything that determines the results of a run, as JSON.

use crate::checksum::sha256_hex;
use serde::Serialize;
use serde_json::{Map, Value};

/// The value of the field `format` of the description of a run.
pub(crate) const RUN_FORMAT: &str = "phase-run/2";
/// Beginning of the formats of all versions.
const ANY_RUN_FORMAT: &str = "phase-run/";

/// The description of a run: what determines its results, its version of the format, and nothing else.
///
/// A run keeps its description in its folder and in its results. Two runs are the same if their descriptions
/// are.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(transparent)]
pub struct Run(Value);

impl Run {
    /// A run that is determined by these members.
    #[must_use]
    pub fn new(members: impl IntoIterator<Item = (&'static str, Value)>) -> Self {
        let members = members.into_iter().map(|(name, value)| (name.to_owned(), value));
        let format = ("format".to_owned(), RUN_FORMAT.into());
        Self(Value::Object(members.chain([format]).collect::<Map<_, _>>()))
    }

    /// This run with another member, or another value of it.
    #[must_use]
    pub fn with(mut self, member: &str, value: impl Into<Value>) -> Self {
        self.0[member] = value.into();
        self
    }

    /// The description as JSON.
    #[must_use]
    pub const fn value(&self) -> &Value {
        &self.0
    }

    /// The first difference of another run from this one, in words; `None` if they are the same.
    #[must_use]
    pub fn difference(&self, other: &Value) -> Option<String> {
        difference(other, &self.0)
    }
}

/// Whether something describes a run in a form that this version no longer continues.
pub(crate) fn is_earlier(value: &Value) -> bool {
    let format = value["format"].as_str().unwrap_or_default();
    format.starts_with(ANY_RUN_FORMAT) && format != RUN_FORMAT
}

/// The canonical form of a value: JSON without spaces, members sorted by name, numbers in the shortest form
/// that reads back to the same value.
#[must_use]
pub fn canonical(value: &Value) -> String {
    let mut text = String::new();
    write_canonical(value, &mut text);
    text
}

/// The SHA-256 of the canonical form of a value, in lower-case hexadecimal.
#[must_use]
pub fn digest(value: &Value) -> String {
    sha256_hex(canonical(value).as_bytes())
}

fn write_canonical(value: &Value, text: &mut String) {
    match value {
        Value::Object(members) => {
            let mut members: Vec<(&String, &Value)> = members.iter().collect();
            members.sort_by_key(|(name, _)| *name);
            text.push('{');
            for (k, (name, value)) in members.into_iter().enumerate() {
                if k > 0 {
                    text.push(',');
                }
                *text += &Value::from(name.as_str()).to_string();
                text.push(':');
                write_canonical(value, text);
            }
            text.push('}');
        }
        Value::Array(items) => {
            text.push('[');
            for (k, item) in items.iter().enumerate() {
                if k > 0 {
                    text.push(',');
                }
                write_canonical(item, text);
            }
            text.push(']');
        }
        plain => *text += &plain.to_string(),
    }
}

/// The first difference between another value and this one.
fn difference(other: &Value, this: &Value) -> Option<String> {
    match (other, this) {
        (Value::Object(a), Value::Object(b)) => {
            let mut keys: Vec<&String> = b.keys().chain(a.keys()).collect();
            keys.sort();
            keys.dedup();
            // The command first: with another command the remainder cannot be compared.
            keys.sort_by_key(|key| *key != "command");
            keys.into_iter().find_map(|key| {
                let a = a.get(key).unwrap_or(&Value::Null);
                let b = b.get(key).unwrap_or(&Value::Null);
                match (a, b) {
                    (Value::Object(_), Value::Object(_)) => {
                        difference(a, b).map(|inner| format!("{key}.{inner}"))
                    }
                    _ if a == b => None,
                    _ => Some(format!("{key} {a} instead of {b}")),
                }
            })
        }
        _ if other == this => None,
        _ => Some(format!("{other} instead of {this}")),
    }
}
