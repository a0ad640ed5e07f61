//! The options of `render`.

use crate::parallel::Jobs;
use clap::{Args, builder::TypedValueParser, value_parser};
use phase_model::AgentId;
use std::path::PathBuf;

/// Options of `render`.
#[derive(Args, Debug)]
pub struct Render {
    /// An event file (phase-events/1) or the folder of a dataset
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Only the event with this id; may be given several times
    #[arg(long, value_name = "ID")]
    pub id: Vec<String>,
    /// Folder for the results, or for a single event a file ending in .mp4 (.png with --contact-sheet)
    #[arg(long, value_name = "DIR|FILE", default_value = "out/render")]
    pub out: PathBuf,
    /// Draw too what agent 0 or 1 sees and believes, and write below why it acts as it does (simulated events only)
    #[arg(long, value_name = "AGENT", value_parser = agent())]
    pub belief: Option<AgentId>,
    /// Instead of a video, one picture of N frames spread evenly over the event
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=100))]
    pub contact_sheet: Option<u16>,
    /// How many events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// An agent by its number.
fn agent() -> impl TypedValueParser<Value = AgentId> {
    value_parser!(u8).range(0..=1).try_map(AgentId::try_from)
}
