//! The options of `render`.

use crate::{output::Output, parallel::Jobs};
use clap::{
    Args, ValueEnum,
    builder::{PossibleValuesParser, TypedValueParser},
    value_parser,
};
use phase_model::AgentId;
use phase_render::PaletteName;
use std::path::PathBuf;

/// Options of `render`.
#[derive(Args, Debug)]
pub struct Render {
    /// A file in the format phase-events/1, or the folder of a dataset or of simulations
    #[arg(value_name = "FILE|DIR")]
    pub file: PathBuf,
    /// Only the event with this id; may be given several times
    #[arg(long, value_name = "ID")]
    pub id: Vec<String>,
    /// Folder for the results, or for a single event a file ending in .mp4 (.png with --contact-sheet)
    #[arg(long, value_name = "DIR|FILE", default_value = "out/render")]
    pub out: PathBuf,
    /// Overlay what agent 0 or 1 sees and believes, or both side by side, and explain its actions below
    /// (simulated events only)
    #[arg(long, value_name = "AGENT")]
    pub belief: Option<Belief>,
    /// Show below the picture what SIMPLE makes of the event while it watches it: goals, relation, who helps
    /// or hinders whom, and how people would report it; and write all of it to a file ending in
    /// .observer.json beside the video
    #[arg(long, conflicts_with = "belief")]
    pub observer: bool,
    /// Random seed of the observer
    #[arg(long, value_name = "S", default_value_t = 1, requires = "observer")]
    pub seed: u64,
    /// Colours: as in the paper, or distinguishable with a colour vision deficiency
    #[arg(long, value_name = "PALETTE", default_value = PaletteName::Paper.name(), value_parser = palettes())]
    pub palette: PaletteName,
    /// Instead of a video, one picture of N frames, 1 to 100, evenly spaced over the event
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=100))]
    pub contact_sheet: Option<u16>,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
    /// Number of events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// Whose beliefs `render` shows.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub enum Belief {
    /// Agent 0's.
    #[value(name = "0", help = "agent 0")]
    First,
    /// Agent 1's.
    #[value(name = "1", help = "agent 1")]
    Second,
    /// Both agents', side by side.
    #[value(name = "both", help = "both agents side by side")]
    Both,
}

impl Belief {
    /// The agents shown, from left to right.
    #[must_use]
    pub const fn agents(self) -> &'static [AgentId] {
        match self {
            Self::First => &[AgentId::ZERO],
            Self::Second => &[AgentId::ONE],
            Self::Both => &AgentId::ALL,
        }
    }

    /// The suffix of file names.
    #[must_use]
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::First => ".belief0",
            Self::Second => ".belief1",
            Self::Both => ".belief-both",
        }
    }
}

/// Reads a palette by its name.
fn palettes() -> impl TypedValueParser<Value = PaletteName> {
    let names = PossibleValuesParser::new(PaletteName::ALL.map(PaletteName::name));
    names.try_map(|name| {
        PaletteName::ALL.into_iter().find(|palette| palette.name() == name).ok_or("no such palette")
    })
}
