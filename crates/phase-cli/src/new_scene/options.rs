//! The options of `new-scene`.

use crate::{named::named, output::Output};
use clap::{Args, value_parser};
use phase_model::{EventKind, Level};
use std::path::PathBuf;

/// Options of `new-scene`.
#[derive(Args, Debug)]
pub struct NewScene {
    /// The kind of event that the scene is set up for
    #[arg(long, value_name = "KIND", default_value = EventKind::Helping.name(),
        value_parser = named(EventKind::ALL, EventKind::name))]
    pub kind: EventKind,
    /// The base layout, 0 to 21 [default: one that fits the kind]
    #[arg(long, value_name = "N", value_parser = value_parser!(u8).range(0..=21))]
    pub layout: Option<u8>,
    /// Level of reasoning, 0 to 2, of agents that do not know each other's goals [default: they know]
    #[arg(long, value_name = "L", value_parser = level)]
    pub level: Option<Level>,
    /// Seed of what is drawn: goals, sizes, strengths, places
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// File for the scene; it must not exist
    #[arg(long, value_name = "FILE", default_value = "scene.json")]
    pub out: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Reads a level of reasoning.
///
/// # Errors
/// For anything but 0, 1 and 2.
pub fn level(text: &str) -> Result<Level, &'static str> {
    text.parse().map_or(Err("must be 0, 1 or 2"), |number: u8| Level::try_from(number))
}
