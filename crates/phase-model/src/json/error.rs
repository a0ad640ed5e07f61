//! What can be wrong with a JSON document, in one plain sentence each.

use thiserror::Error;

/// Why something is no JSON document of the format expected.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum JsonError {
    /// It holds nothing.
    #[error("is empty")]
    Empty,
    /// It is not text at all: a picture, a video, an archive.
    #[error("is not JSON text (byte {0} is not valid UTF-8)")]
    NotText(usize),
    /// It is text but not JSON.
    #[error("is not JSON: {what} in line {line}")]
    NotJson {
        /// What stands there.
        what: String,
        /// Line of the mistake, from 1.
        line: usize,
    },
    /// It ends in the middle.
    #[error("is truncated: the JSON ends unfinished in line {0}")]
    Truncated(usize),
    /// A number is written as NaN or an infinity.
    #[error("holds {token} in line {line}: numbers must be finite")]
    NotANumber {
        /// What stands there.
        token: String,
        /// Line, from 1.
        line: usize,
    },
    /// A number is too large to be one.
    #[error("holds a number in line {0} that is too large: numbers must be finite")]
    NumberTooLarge(usize),
    /// It is JSON of another kind.
    #[error("field `format` must be {expected:?}, {found}")]
    Format {
        /// What it must be.
        expected: &'static str,
        /// What it is, in words.
        found: String,
    },
}

/// A field that breaks a rule.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
#[error("{}{rule}", field_prefix(field))]
pub struct FieldError {
    /// Where in the file, such as `agents[0].radius`; empty for the file or event as a whole.
    pub field: String,
    /// What it breaks, such as `must be a finite number, not null`.
    pub rule: String,
}

fn field_prefix(field: &str) -> String {
    if field.is_empty() { String::new() } else { format!("field `{field}` ") }
}
