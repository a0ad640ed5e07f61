//! What can be wrong with a file of probes or runs.

use thiserror::Error;

/// Why a file of probes or runs cannot be used, in one plain sentence.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum ReadError {
    /// It is not JSON, or holds a number too large to be one.
    #[error("is not JSON: {0}")]
    NotJson(String),
    /// A field breaks a rule.
    #[error("field `{field}` {rule}")]
    Field {
        /// Where in the file, such as `probes[3].actions`.
        field: String,
        /// What it breaks, such as `is missing`.
        rule: String,
    },
}
