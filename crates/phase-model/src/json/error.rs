//! Errors in JSON documents, each displayed as one plain sentence.

use crate::foreign;
use thiserror::Error;

/// The reason why something is not a JSON document of the expected format.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum JsonError {
    /// The document is empty.
    #[error("is empty")]
    Empty,
    /// It is not text at all: an image, a video, an archive.
    #[error("is not text (byte {0} is not valid UTF-8)")]
    NotText(usize),
    /// It is text but not JSON.
    #[error("is not JSON: {what} in line {line}")]
    NotJson {
        /// The unexpected content.
        what: String,
        /// Line of the error, from 1.
        line: usize,
    },
    /// The document is truncated.
    #[error("is truncated: the JSON ends unfinished in line {0}")]
    Truncated(usize),
    /// An object has two members of one name; which of them counts differs from reader to reader.
    #[error("has the member `{}` twice, again in line {line}", foreign::name(member))]
    Twice {
        /// The name.
        member: String,
        /// Line of the second, from 1.
        line: usize,
    },
    /// A number is written as NaN or an infinity.
    #[error("holds {token} in line {line}: numbers must be finite")]
    NotANumber {
        /// The content found instead of a number.
        token: String,
        /// Line, from 1.
        line: usize,
    },
    /// A number is out of range.
    #[error("holds a number in line {0} that is too large: numbers must be finite")]
    NumberTooLarge(usize),
    /// It is JSON of another format.
    #[error("field `format` must be {expected:?}, {found}")]
    Format {
        /// The expected format.
        expected: &'static str,
        /// The format found, in words.
        found: String,
    },
}

/// A field that breaks a rule.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
#[error("{}{rule}", field_prefix(field))]
pub struct FieldError {
    /// Path in the file, such as `agents[0].radius`; empty for the file or event as a whole.
    pub field: String,
    /// The rule, such as `must be a finite number, not null`.
    pub rule: String,
}

fn field_prefix(field: &str) -> String {
    if field.is_empty() { String::new() } else { format!("field `{field}` ") }
}
