//! JSON documents as trees of fields that know where they stand, for readers that check what they read.
//!
//! A derived reader would be shorter, but its errors name types and columns; a person wants the field and the rule.

mod error;
mod field;
mod parse;
mod similar;

pub use error::{FieldError, JsonError};
pub use field::{Field, finite, shown};
pub use parse::{check_format, parse, parse_text};
