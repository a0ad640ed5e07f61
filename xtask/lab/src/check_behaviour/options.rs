//! The options of `check-behaviour`.

use super::sets::SceneSet;
use clap::{Args, value_parser};
use phase_cli::new_scene::options::level;
use phase_cli::{effort::SimulationOptions, json_file::JsonFile, parallel::Jobs};
use phase_model::Level;
use std::path::PathBuf;

/// Options of `check-behaviour`.
#[derive(Args, Debug)]
pub struct CheckBehaviour {
    /// The report as JSON.
    #[command(flatten)]
    pub json: JsonFile,
    /// Only these rows of the table in docs/results/behaviour.md
    #[arg(long, value_name = "N", num_args = 1.., value_parser = value_parser!(u8).range(1..=12))]
    pub row: Vec<u8>,
    /// Events of each scene: seeds 1 to N, which use the five reflections in rotation
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = value_parser!(u16).range(1..=10_000))]
    pub seeds: u16,
    /// Folder for report and contact sheets; new, empty, or of such a check, whose results are replaced
    #[arg(long, value_name = "DIR", default_value = "out/behaviour")]
    pub out: PathBuf,
    /// Set of bundled scenes to simulate
    #[arg(long, value_name = "SET", value_enum, default_value_t, conflicts_with = "scenes")]
    pub set: SceneSet,
    /// Folder with other scenes
    #[arg(long, value_name = "DIR")]
    pub scenes: Option<PathBuf>,
    /// Level of reasoning, 0 to 2, of agents that do not know each other's goals [default: they know]
    #[arg(long, value_name = "L", value_parser = level)]
    pub level: Option<Level>,
    /// JSON file of parameters of the minds, as of `check-minds`; options that say otherwise prevail
    #[arg(long, value_name = "FILE")]
    pub parameters: Option<PathBuf>,
    /// Parameters of the agents.
    #[command(flatten)]
    pub effort: SimulationOptions,
    /// Number of events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

impl CheckBehaviour {
    /// The folders with the scenes.
    #[must_use]
    pub fn folders(&self) -> Vec<PathBuf> {
        self.scenes.clone().map_or_else(|| self.set.folders(), |folder| vec![folder])
    }
}
