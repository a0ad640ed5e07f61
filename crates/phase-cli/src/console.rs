//! Talking to whoever started us.
//!
//! The standard macros panic when nobody listens any more (`… | head`); a run must not end for that.

use std::{
    fmt::Display,
    io::{self, Write},
};

/// Writes a result to stdout, on a line of its own.
pub fn tell(line: impl Display) {
    let _ = writeln!(io::stdout(), "{line}");
}

/// Writes a remark to stderr, on a line of its own.
pub fn remark(line: impl Display) {
    let _ = writeln!(io::stderr(), "{line}");
}
