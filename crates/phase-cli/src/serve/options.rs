//! Options of `serve`.

#[cfg(feature = "serve")]
use crate::error::CliError;
use crate::{address, effort::SimulationOptions, named::named};
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
    #[arg(long, value_name = "HOST", value_parser = address::host)]
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
    /// Scenes of a game after the practice, 1 to 1000; those that were played least come first [default: 5]
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=1000))]
    pub rounds: Option<u16>,
    /// Games at the same time, 1 to 10000 [default: 200]
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=10_000))]
    pub rooms: Option<u16>,
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
    /// nothing else on this server, unless --scenes is given too; without it, options of games are refused
    #[arg(long = "study", value_name = "FILE")]
    pub studies: Vec<PathBuf>,
    /// Seed of the order of scenes and of the minds that play [default: 1]
    #[arg(long, value_name = "SEED")]
    pub seed: Option<u64>,
    /// Engine, length of a round and minds.
    #[command(flatten)]
    pub simulation: SimulationOptions,
    /// Folder with phase.js and phase_bg.wasm for the playground, instead of those that this program includes
    #[arg(long, value_name = "DIR")]
    pub wasm: Option<PathBuf>,
}

#[cfg(feature = "serve")]
impl Serve {
    /// Whether raters find studies and nothing else.
    pub(super) fn only_studies(&self) -> bool {
        !self.studies.is_empty() && self.scenes.is_none()
    }

    /// Whether there is something that each option is about: without games, none of theirs.
    pub(super) fn check(&self) -> Result<(), CliError> {
        let SimulationOptions { engine, minds, foresight, prior, particles, max_steps } = &self.simulation;
        let of_games = [
            ("--rounds", self.rounds.is_some()),
            ("--rooms", self.rooms.is_some()),
            ("--mind-rooms", self.mind_rooms.is_some()),
            ("--invite-only", self.invite_only),
            ("--inertia", self.inertia),
            ("--seed", self.seed.is_some()),
            ("--engine", engine.is_some()),
            ("--minds", minds.minds.is_some()),
            ("--one-way-turns", minds.one_way_turns),
            ("--strongest-coasts", minds.strongest_coasts),
            ("--original-random", minds.original_random),
            ("--simulations", minds.simulations.is_some()),
            ("--foresight", foresight.is_some()),
            ("--prior", prior.is_some()),
            ("--particles", particles.is_some()),
            ("--max-steps", max_steps.is_some()),
            ("--wasm", self.wasm.is_some()),
        ];
        match of_games.iter().find(|(_, given)| *given).filter(|_| self.only_studies()) {
            Some((option, _)) => {
                let rule = "is about games and the playground; with --study these need --scenes";
                Err(CliError::Usage(format!("{option}: {rule}")))
            }
            None => Ok(()),
        }
    }
}
