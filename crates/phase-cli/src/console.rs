//! Lines for the user.
//!
//! The standard macros panic on a closed pipe (`… | head`), which must not end a run.

use crate::error::CliError;
use phase_model::foreign;
use std::{
    fmt::Display,
    io::{self, Write},
};

/// Writes a line to stdout, where results go. What others wrote in it steers no terminal.
///
/// # Errors
/// [`CliError::Stdout`]: a result that nobody got is none.
pub fn print_result(line: impl Display) -> Result<(), CliError> {
    print_text(&format!("{}\n", foreign::message(&line.to_string())))
}

/// Writes a text to stdout as it is.
///
/// # Errors
/// [`CliError::Stdout`].
pub fn print_text(text: &str) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(CliError::Stdout)
}

/// Writes a line to stderr, where progress, notes and errors go. What others wrote in it steers no terminal.
pub fn print_message(line: impl Display) {
    // There is no other place to say that it failed.
    let _ = writeln!(io::stderr(), "{}", foreign::message(&line.to_string()));
}
