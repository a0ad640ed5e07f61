//! The options of `simulate`.

use crate::{effort::SimulationOptions, output::Output, parallel::Jobs};
use clap::{Args, value_parser};
use phase_runs::simulate::Simulations;
use std::path::PathBuf;

/// Options of `simulate`.
#[derive(Args, Debug)]
pub struct Simulate {
    /// A file in the format phase-events/1, or the folder of a dataset or of simulations
    #[arg(long, value_name = "FILE|DIR")]
    pub events: PathBuf,
    /// Only the event with this id; may be given several times
    #[arg(long, value_name = "ID")]
    pub id: Vec<String>,
    /// Random seed of the simulations of events without their own `seed`
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Simulate every scene with the seeds S to S + N - 1, N from 1 to 10000; with more than one, ids end in
    /// -seedK
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u16).range(1..=10_000))]
    pub seeds: u16,
    /// Give all events of the file the same random numbers: the seed of each is drawn from S alone, and not
    /// also from the event's place in the file, so that scenes which differ in one thing (a goal, an
    /// attitude) differ in nothing else
    #[arg(long)]
    pub same_chance: bool,
    /// Make no videos and no page
    #[arg(long)]
    pub no_video: bool,
    /// Folder for the results; new, empty, or of the same run
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
    /// Parameters of the agents.
    #[command(flatten)]
    pub effort: SimulationOptions,
    /// Number of events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

impl From<&Simulate> for Simulations {
    fn from(options: &Simulate) -> Self {
        Self {
            events: options.events.clone(),
            ids: options.id.clone(),
            seed: options.seed,
            seeds: options.seeds,
            same_chance: options.same_chance,
            videos: !options.no_video,
            out: options.out.clone(),
            effort: options.effort.effort(),
            threads: options.jobs.given(),
        }
    }
}
