//! Options of `serve`.

use crate::{effort::SimulationOptions, named::named};
use clap::{Args, value_parser};
use phase_dataset::splits::Split;
use std::{net::SocketAddr, path::PathBuf};

/// Options of `serve`.
#[derive(Args, Debug)]
pub struct Serve {
    /// Address and port to listen on. Others than the loopback interface can be reached from outside
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1:8017")]
    pub listen: SocketAddr,
    /// Port on 127.0.0.1 to listen on, 0 to 65535; with 0 the system chooses one
    #[arg(long, value_name = "PORT", conflicts_with = "listen")]
    pub port: Option<u16>,
    /// Name of this server for others, such as lab.example.org; requests by names that it does not have are
    /// refused
    #[arg(long, value_name = "HOST")]
    pub host: Option<String>,
    /// A proxy in front of this server names the client (X-Forwarded-For)
    #[arg(long)]
    pub behind_proxy: bool,
    /// Folder for journals and recordings of games and for the answers of studies; a server that is started
    /// again goes on with what it finds there
    #[arg(long, value_name = "DIR", default_value = "out/serve")]
    pub out: PathBuf,
    /// Scenes to play: a phase-events/1 file or the folder of a dataset [default: 24 sampled scenes, four of
    /// each kind]
    #[arg(long, value_name = "PATH")]
    pub scenes: Option<PathBuf>,
    /// Only the dataset's events of this split: train, validation or test
    #[arg(
        long,
        value_name = "SPLIT",
        hide_possible_values = true,
        requires = "scenes",
        value_parser = named(Split::ALL, Split::name)
    )]
    pub split: Option<Split>,
    /// Scenes of a game after the practice, 1 to 1000; those that were played least come first
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = value_parser!(u16).range(1..=1000))]
    pub rounds: u16,
    /// Games at the same time, 1 to 10000
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = value_parser!(u16).range(1..=10_000))]
    pub rooms: u16,
    /// Of them games in which a mind plays, 0 to 10000 [default: 12 for each core]
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(0..=10_000))]
    pub mind_rooms: Option<u16>,
    /// Only the holder of the admin token opens games
    #[arg(long)]
    pub invite_only: bool,
    /// Agents keep their velocity from step to step, as in simulations; in the paper's game they are stopped
    /// after each step
    #[arg(long)]
    pub inertia: bool,
    /// A rating study (phase-study/1); may be given several times. Its page is /study/NAME/. Raters find
    /// nothing else on this server, unless --scenes is given too
    #[arg(long = "study", value_name = "FILE")]
    pub studies: Vec<PathBuf>,
    /// Seed of the order of scenes and of the minds that play
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    pub seed: u64,
    /// Engine, length of a round and minds.
    #[command(flatten)]
    pub simulation: SimulationOptions,
    /// Folder with phase.js and phase_bg.wasm for the playground, instead of those that this program includes
    #[arg(long, value_name = "DIR")]
    pub wasm: Option<PathBuf>,
}
