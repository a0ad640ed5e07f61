//! The options of `fit-inference`.

use clap::{Args, value_parser};
use phase_agent::MindKind;
use phase_cli::{effort::mind_kinds, parallel::Jobs};
use std::path::PathBuf;

/// Options of `fit-inference`.
#[derive(Args, Debug)]
pub struct FitInference {
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
    /// The weights of one kind of minds alone: `phase`, or `published`, those of the published simulator [default: both
    /// kinds, averaged, as SIMPLE has them]
    #[arg(long, value_name = "MINDS", hide_possible_values = true, value_parser = mind_kinds())]
    pub minds: Option<MindKind>,
    /// Parts into which the events are divided; each is held out of one fit
    #[arg(long, value_name = "K", default_value_t = 5, value_parser = value_parser!(u16).range(2..=1000))]
    pub folds: u16,
    /// JSON file of the parameters of the minds, of which all that are absent have their defaults; of one kind alone
    #[arg(long, value_name = "FILE", conflicts_with = "minds")]
    pub parameters: Option<PathBuf>,
    /// POMCP simulations a decision [default: SIMPLE's, 50, with published minds 100]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=10_000_000))]
    pub simulations: Option<u32>,
    /// Steps from one decision that is looked at to the next [default: SIMPLE's, 3]
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=1000))]
    pub interval: Option<u16>,
    /// Where to write the fitted weights as JSON; the evidence on each event is kept in a file beside it, and the same command
    /// goes on from there
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// The seed of all random draws, the same in every event, and of the division into folds
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// How many events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}
