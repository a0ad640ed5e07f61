//! Lines for the user.
//!
//! The standard macros panic on a closed pipe (`… | head`), which must not end a run.

use std::{
    fmt::Display,
    io::{self, Write},
};

/// Writes a line to stdout, where results go.
pub fn print_result(line: impl Display) {
    let _ = writeln!(io::stdout(), "{line}");
}

/// Writes a line to stderr, where progress, notes and errors go.
pub fn print_message(line: impl Display) {
    let _ = writeln!(io::stderr(), "{line}");
}
