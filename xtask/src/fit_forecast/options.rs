//! The options of `fit-forecast`.

use clap::{Args, value_parser};
use phase_cli::parallel::Jobs;
use std::path::PathBuf;

/// Options of `fit-forecast`.
#[derive(Args, Debug)]
pub struct FitForecast {
    /// The events to fit to: a file in the format phase-events/1, or the folder of a dataset or of simulations; may be given
    /// several times
    #[arg(long, value_name = "FILE|DIR", required = true)]
    pub events: Vec<PathBuf>,
    /// Further events, to which nothing is fitted; their figures are reported beside. May be given several times
    #[arg(long, value_name = "FILE|DIR")]
    pub held_out: Vec<PathBuf>,
    /// Only the first N events of each file
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..))]
    pub limit: Option<u32>,
    /// Where to write the fitted settings as JSON; the futures of each event are kept in a file beside it, and the same command goes
    /// on from there
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// The seed of all random draws, the same in every event
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// How many events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}
