//! JSON documents as trees of fields that know their paths, for readers that validate their input. A derived
//! reader would be shorter, but its errors would name types and columns instead of the field and the rule.

mod error;
mod field;
mod parse;
mod similar;
mod typed;

pub use error::{FieldError, JsonError};
pub use field::{Field, finite, shown};
pub use parse::{check_format, parse, parse_as, parse_line, parse_text};
pub use similar::edit_distance;
pub use typed::read_as;
