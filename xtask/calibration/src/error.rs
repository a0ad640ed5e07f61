//! Errors in files of probes or runs.

use thiserror::Error;

/// Reason that a file of probes or runs cannot be used, in one plain sentence.
#[derive(Debug, Error)]
pub enum ReadError {
    /// It is not JSON, or contains a number that is out of range.
    #[error("is not JSON: {0}")]
    NotJson(#[from] serde_json::Error),
    /// A field has the wrong type or shape.
    #[error("field `{field}` must be {shape}: {source}")]
    Shape {
        /// Place in the file, such as `probes[3].actions`.
        field: String,
        /// The expected value, such as `four numbers`.
        shape: String,
        /// The value that is there instead.
        source: serde_json::Error,
    },
    /// A field violates a rule.
    #[error("field `{field}` {rule}")]
    Field {
        /// Place in the file, such as `probes[3].actions`.
        field: String,
        /// The rule, such as `is missing`.
        rule: String,
    },
}
