//! The options of `check-physics`.

use clap::Args;
use phase_cli::effort::engines;
use phase_sim::Engine;
use std::path::PathBuf;

/// Options of `check-physics`; at least one of the three files is needed.
#[derive(Args, Debug)]
pub struct CheckPhysics {
    /// File of probes: a few steps of one effect each
    #[arg(long, value_name = "FILE")]
    pub probes: Option<PathBuf>,
    /// File of runs: many steps of everything
    #[arg(long, value_name = "FILE")]
    pub runs: Option<PathBuf>,
    /// A file in the format phase-events/1 or a folder of events; those with recovered actions are replayed
    #[arg(long, value_name = "FILE|DIR")]
    pub events: Option<PathBuf>,
    /// The engine to check
    #[arg(long, value_name = "ENGINE", default_value = Engine::World.name(), value_parser = engines())]
    pub engine: Engine,
    /// Print the measurements as one JSON object on stdout, and nothing else there; or, with a file, write it
    /// there too
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "-")]
    pub json: Option<PathBuf>,
}
