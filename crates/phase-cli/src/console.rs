//! Lines for the user.
//!
//! The standard macros panic on a closed pipe (`… | head`), which must not end a run.

use phase_files::plain_reason;
use phase_model::foreign;
use std::{
    cell::Cell,
    fmt::Display,
    io::{self, Write},
};
use thiserror::Error;

thread_local! {
    static SILENT: Cell<bool> = const { Cell::new(false) };
}

/// A result that nobody got, and so none.
#[derive(Debug, Error)]
#[error("the result cannot be written to stdout: {}", plain_reason(.0))]
pub struct Unprinted(#[from] pub io::Error);

/// Writes a text to stdout, where results go, as it is.
///
/// # Errors
/// [`Unprinted`].
pub fn write_result(text: &str) -> Result<(), Unprinted> {
    if SILENT.get() {
        return Ok(());
    }
    let mut out = io::stdout().lock();
    Ok(out.write_all(text.as_bytes()).and_then(|()| out.flush())?)
}

/// Runs a command whose results are not printed, for programs that this one is a part of. Stdout is the whole
/// process's, so only what this thread prints is left out.
pub fn without_results<T>(command: impl FnOnce() -> T) -> T {
    let before = SILENT.replace(true);
    let done = command();
    SILENT.set(before);
    done
}

/// Writes a line to stderr, where progress, notes and errors go. What others wrote in it steers no terminal.
pub fn print_message(line: impl Display) {
    // There is no other place to say that it failed.
    let _ = writeln!(io::stderr(), "{}", foreign::message(&line.to_string()));
}
