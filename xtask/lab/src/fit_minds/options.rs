//! The options of `fit-minds`.

use super::parameter::PARAMETERS;
use clap::{Args, builder::PossibleValuesParser, value_parser};
use phase_cli::parallel::Jobs;
use std::path::PathBuf;

/// Options of `fit-minds`.
#[derive(Args, Debug)]
pub struct FitMinds {
    /// The events to fit to: a file in the format phase-events/1, or the folder of a dataset or of
    /// simulations
    #[arg(long, value_name = "FILE|DIR")]
    pub events: PathBuf,
    /// Further events, to which nothing is fitted; their figures are reported beside
    #[arg(long, value_name = "FILE|DIR")]
    pub generated: Option<PathBuf>,
    /// Parts into which the events are divided; each is held out of one fit
    #[arg(long, value_name = "K", default_value_t = 5, value_parser = value_parser!(u16).range(2..=1000))]
    pub folds: u16,
    /// Decide at one of so many observed states
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = value_parser!(u16).range(1..=1000))]
    pub thin: u16,
    /// JSON file of the parameters to start from, of which all that are absent have their defaults
    #[arg(long, value_name = "FILE")]
    pub parameters: Option<PathBuf>,
    /// File for the result (JSON); evaluations are kept in a file beside it, and the same command goes on
    /// from there
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// The parameters to change, separated by commas [default: all]
    #[arg(long, value_name = "NAME,..", value_delimiter = ',', value_parser = names())]
    pub only: Vec<String>,
    /// Rounds over the parameters at most
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = value_parser!(u16).range(1..=100))]
    pub rounds: u16,
    /// POMCP simulations a decision
    #[arg(long, value_name = "N", default_value_t = 50,
        value_parser = value_parser!(u32).range(phase_minds::SIMULATIONS.bounds()))]
    pub simulations: u32,
    /// In place of a fit, show what the parameters are worth: the figures with each of them at its neutral
    /// value
    #[arg(long, conflicts_with_all = ["folds", "rounds"])]
    pub ablation: bool,
    /// The seed of all random draws, the same in every event, and of the division into folds
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Number of evaluations at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// Reads the name of a parameter.
fn names() -> PossibleValuesParser {
    PossibleValuesParser::new(PARAMETERS.iter().map(|it| it.name))
}
