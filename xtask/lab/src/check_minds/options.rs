//! The options of `check-minds`.

use clap::{Args, value_parser};
use phase_cli::{json_file::JsonFile, named::named, parallel::Jobs};
use phase_minds::MindKind;
use phase_model::EventKind;
use std::path::PathBuf;

/// Options of `check-minds`.
#[derive(Args, Debug)]
pub struct CheckMinds {
    /// A file in the format phase-events/1, or the folder of a dataset or of simulations
    #[arg(long, value_name = "FILE|DIR")]
    pub events: PathBuf,
    /// Only events of this kind
    #[arg(long, value_name = "KIND", value_parser = named(EventKind::ALL, EventKind::name))]
    pub only: Option<EventKind>,
    /// Only the events with these ids
    #[arg(long, value_name = "ID", num_args = 1..)]
    pub ids: Vec<String>,
    /// The minds: `phase`, or `published`, those of the published simulator [default: phase]
    #[arg(long, value_name = "MINDS", hide_possible_values = true,
        value_parser = named(MindKind::ALL, MindKind::name))]
    pub minds: Option<MindKind>,
    /// Published minds draw the random numbers of the original, which repeat in every search; as it searched
    /// once with 1000 simulations, so should they
    #[arg(long)]
    pub original_random: bool,
    /// JSON file of parameters of the minds, of which all that are absent have their defaults; it does not
    /// say how many simulations there are
    #[arg(long, value_name = "FILE")]
    pub parameters: Option<PathBuf>,
    /// POMCP simulations a decision at observed states [default: 50, with published minds 200]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(phase_minds::SIMULATIONS.bounds()))]
    pub simulations: Option<u32>,
    /// Searches of so many simulations a decision at observed states, which only published minds repeat
    /// [default: 5]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=1000))]
    pub searches: Option<u32>,
    /// POMCP simulations a decision in the open loop
    #[arg(long, value_name = "N", default_value_t = 1000,
        value_parser = value_parser!(u32).range(phase_minds::SIMULATIONS.bounds()))]
    pub simulations_open_loop: u32,
    /// Simulations of every scene in the open loop; with 0 that part is left out
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u16).range(0..=1000))]
    pub open_loop_seeds: u16,
    /// The seed of all random draws, the same in every event
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// The report as JSON.
    #[command(flatten)]
    pub json: JsonFile,
    /// Number of events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}
