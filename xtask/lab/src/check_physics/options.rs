//! The options of `check-physics`.

use clap::Args;
use phase_cli::{json_file::JsonFile, named::named};
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
    #[arg(long, value_name = "ENGINE", default_value = Engine::World.name(),
        value_parser = named(Engine::ALL, Engine::name))]
    pub engine: Engine,
    /// The report as JSON.
    #[command(flatten)]
    pub json: JsonFile,
}
