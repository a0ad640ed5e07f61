//! Lines for whoever started the program.
//!
//! The standard macros panic when nobody listens any more (`… | head`); a run must not end for that.

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
