//! The options of `simulate`.

use crate::{effort::Effort, parallel::Jobs};
use clap::{Args, value_parser};
use std::path::PathBuf;

/// Options of `simulate`.
#[derive(Args, Debug)]
pub struct Simulate {
    /// File in the format phase-events/1
    #[arg(long, value_name = "FILE")]
    pub events: PathBuf,
    /// Only the event with this id; may be given several times
    #[arg(long, value_name = "ID")]
    pub id: Vec<String>,
    /// Seed of all chance in the simulations of events that have no `seed` of their own
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Simulate every scene with the seeds S to S + N - 1; with more than one, ids end in -seedK
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u16).range(1..=10_000))]
    pub seeds: u16,
    /// Make no videos
    #[arg(long)]
    pub no_video: bool,
    /// Folder for the results; new, empty, or of this very run
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// How the agents think.
    #[command(flatten)]
    pub effort: Effort,
    /// How many events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}
