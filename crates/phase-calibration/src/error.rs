//! What can be wrong with a file of probes or runs.

use thiserror::Error;

/// Why a file of probes or runs cannot be used, in one plain sentence.
#[derive(Debug, Error)]
pub enum ReadError {
    /// It is not JSON, or holds a number too large to be one.
    #[error("is not JSON: {0}")]
    NotJson(#[from] serde_json::Error),
    /// A field is of another type or shape than it has to be.
    #[error("field `{field}` must be {shape}: {source}")]
    Shape {
        /// Where in the file, such as `probes[3].actions`.
        field: String,
        /// What it must be, such as `four numbers`.
        shape: String,
        /// Why it is not.
        source: serde_json::Error,
    },
    /// A field breaks a rule.
    #[error("field `{field}` {rule}")]
    Field {
        /// Where in the file, such as `probes[3].actions`.
        field: String,
        /// What it breaks, such as `is missing`.
        rule: String,
    },
}
