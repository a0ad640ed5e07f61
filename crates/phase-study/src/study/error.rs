//! Why a study refuses something.

use crate::store::StoreError;
use phase_model::json::FieldError;
use thiserror::Error;

/// Why a study refuses something.
#[derive(Debug, Error)]
pub enum StudyError {
    /// Nobody has this token.
    #[error("nobody takes part in this study with this token")]
    Token,
    /// The rater is at another page.
    #[error("it is not the time for the page {0:?}")]
    NotNow(&'static str),
    /// The question has another answer already.
    #[error("this was answered before, and otherwise")]
    OtherAnswer,
    /// An answer breaks a rule.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// The answers cannot be read or written.
    #[error(transparent)]
    Store(#[from] StoreError),
}
