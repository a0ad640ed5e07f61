//! The result of a command: text for people, or one JSON object for programs.

use crate::{console::write_result, error::CliError};
use clap::Args;
use phase_model::foreign;
use serde::Serialize;
use std::fmt::Display;

/// Form in which the result is printed.
#[derive(Args, Clone, Copy, Debug, Default)]
pub struct Output {
    /// Print the result as one JSON object on stdout, and nothing else there
    #[arg(long)]
    pub json: bool,
}

impl Output {
    /// Prints a result, as text without the white space at its end or as JSON.
    ///
    /// # Errors
    /// [`CliError::Serialise`] or [`CliError::Stdout`].
    pub fn print(self, text: impl Display, value: &impl Serialize) -> Result<(), CliError> {
        if self.json {
            return print_json(value);
        }
        print_result(text.to_string().trim_end())
    }
}

/// Writes a line to stdout, where results go. What others wrote in it steers no terminal.
///
/// # Errors
/// [`CliError::Stdout`].
pub fn print_result(line: impl Display) -> Result<(), CliError> {
    Ok(write_result(&format!("{}\n", foreign::message(&line.to_string())))?)
}

/// Prints a value as one JSON object.
///
/// # Errors
/// [`CliError::Serialise`] or [`CliError::Stdout`].
pub fn print_json(value: &impl Serialize) -> Result<(), CliError> {
    Ok(write_result(&foreign::json(&json_text(value, "the result")?))?)
}

/// A value as the text of a JSON file, its last line ended. `what` names it in errors.
///
/// # Errors
/// [`CliError::Serialise`].
pub fn json_text(value: &impl Serialize, what: &'static str) -> Result<String, CliError> {
    let text = serde_json::to_string_pretty(value);
    text.map(|text| text + "\n").map_err(|source| CliError::Serialise { what, source })
}
