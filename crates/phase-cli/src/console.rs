//! Lines for the user.
//!
//! The standard macros panic on a closed pipe (`… | head`), which must not end a run.

use phase_files::plain_reason;
use phase_model::foreign;
use std::{
    fmt::Display,
    io::{self, Write},
};
use thiserror::Error;

/// A result that nobody got, and so none.
#[derive(Debug, Error)]
#[error("the result cannot be written to stdout: {}", plain_reason(.0))]
pub struct Unprinted(#[from] pub io::Error);

/// Writes a text to stdout, where results go, as it is.
///
/// # Errors
/// [`Unprinted`].
pub fn write_result(text: &str) -> Result<(), Unprinted> {
    let mut out = io::stdout().lock();
    Ok(out.write_all(text.as_bytes()).and_then(|()| out.flush())?)
}

/// Writes a line to stderr, where progress, notes and errors go. What others wrote in it steers no terminal.
pub fn print_message(line: impl Display) {
    // There is no other place to say that it failed.
    let _ = writeln!(io::stderr(), "{}", foreign::message(&line.to_string()));
}
