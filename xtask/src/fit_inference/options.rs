//! The options of `fit-inference`.

use clap::{Args, value_parser};
use phase_cli::parallel::Jobs;
use std::path::PathBuf;

/// Options of `fit-inference`.
#[derive(Args, Debug)]
pub struct FitInference {
    /// The events to fit to: a file in the format phase-events/1, or the folder of a dataset or of simulations
    #[arg(long, value_name = "FILE|DIR")]
    pub events: PathBuf,
    /// Further events, to which nothing is fitted; their figures are reported beside
    #[arg(long, value_name = "FILE|DIR")]
    pub generated: Option<PathBuf>,
    /// Parts into which the events are divided; each is held out of one fit
    #[arg(long, value_name = "K", default_value_t = 5, value_parser = value_parser!(u16).range(2..=1000))]
    pub folds: u16,
    /// JSON file of the parameters of the minds, of which all that are absent have their defaults
    #[arg(long, value_name = "FILE")]
    pub parameters: Option<PathBuf>,
    /// POMCP simulations a decision
    #[arg(long, value_name = "N", default_value_t = 50, value_parser = value_parser!(u32).range(1..=10_000_000))]
    pub simulations: u32,
    /// The seed of all random draws, the same in every event, and of the division into folds
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// How many events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}
