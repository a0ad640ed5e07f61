//! `narrate`: events in words.

use crate::{context::Context, error::CliError, output::Output};
use clap::{Args, ValueEnum};
use phase_evidence::Narrative;
use phase_model::words::Names;
use phase_runs::source::{EventInput, track};
use serde_json::json;
use std::{fmt::Write as _, path::PathBuf};

/// Options of `narrate`.
#[derive(Args, Debug)]
pub struct Narrate {
    /// A file in the format phase-events/1, or the folder of a dataset or of simulations
    #[arg(value_name = "FILE|DIR")]
    pub events: PathBuf,
    /// Only the event with this id; may be given several times
    #[arg(long, value_name = "ID")]
    pub id: Vec<String>,
    /// Length of the description
    #[arg(long, value_name = "LENGTH", default_value = "medium")]
    pub length: LengthName,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// A length of a description.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub enum LengthName {
    /// One sentence
    Short,
    /// And each agent's goal, and the manner of help or hindrance
    Medium,
    /// And everything that happens, with times
    Long,
    /// The happenings alone, without goals, attitudes and outcomes
    Seen,
}

/// Runs the command.
///
/// # Errors
/// If the events cannot be used.
pub fn run(arguments: &Narrate, context: &Context) -> Result<(), CliError> {
    let source = EventInput::open(&arguments.events, &arguments.id, context)?;
    let mut text = String::new();
    let mut values = Vec::with_capacity(source.len());
    for index in 0..source.len() {
        let recording = source.load(index)?;
        let narrative = Narrative::of(&recording.scene, &track(&recording), &Names::PAPER);
        let told = match arguments.length {
            LengthName::Short => &narrative.short,
            LengthName::Medium => &narrative.medium,
            LengthName::Long => &narrative.long,
            LengthName::Seen => &narrative.seen,
        };
        let _ = match source.len() {
            1 => writeln!(text, "{told}"),
            _ => writeln!(text, "{}\n{told}\n", recording.id),
        };
        let Narrative { short, medium, long, seen } = narrative;
        values.push(
            json!({ "id": recording.id, "short": short, "medium": medium, "long": long, "seen": seen }),
        );
    }
    arguments.output.print(text, &json!({ "events": values }))
}
