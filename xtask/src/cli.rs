//! The commands and their options.

use crate::{benchmark::options::Benchmark, eval::options::Eval};
use clap::{
    Args, Parser, Subcommand,
    builder::{PossibleValuesParser, TypedValueParser},
    error::ErrorKind,
    value_parser,
};
use phase_agent::Foresight;
use phase_model::AgentId;
use phase_sim::{Engine, Settings};
use std::path::PathBuf;

/// Physically grounded social events: two agents see, believe, plan and act.
#[derive(Parser, Debug)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", version)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Make a dataset of social events, with videos and a page to look at them
    GenDataset(GenDataset),
    /// Put the shards of a dataset together
    Merge(Merge),
    /// Check how a dataset is divided into train, validation and test, or divide it
    Splits(Splits),
    /// Show the figures of the paper's dataset beside those of another, and plot them
    Stats(Stats),
    /// Simulate the scenes of a phase-events/1 file, each from its first row
    Simulate(Simulate),
    /// Check that a dataset is whole: every checksum, no file too many, and that its files agree
    Verify(Verify),
    /// Turn events into videos, or into pictures of their key frames
    Render(Render),
    /// Hold an engine of the physics against recorded motion
    CheckPhysics(CheckPhysics),
    /// Show how reliably agents do what they are planned to do
    CheckBehaviour(CheckBehaviour),
    /// Measure how well a method perceives events: recognises goals and relations, or predicts trajectories
    #[command(subcommand)]
    Eval(Eval),
    /// Measure all methods at both tasks and put them beside what is published, in one report
    Benchmark(Benchmark),
    /// Check the rules of the house that the compiler cannot
    Tidy,
}

/// Options of `gen-dataset`.
#[derive(Args, Debug)]
pub struct GenDataset {
    /// What to make: demo (twelve events, two of each kind, as they come), phase-500 (the paper's composition,
    /// selected), phase-training (as much of the same to learn from as is wanted), or a file in the format phase-preset/2 whose name ends in .json
    #[arg(long, default_value = "demo")]
    pub preset: String,
    /// Number of events [default: the preset's]
    #[arg(long, value_name = "N", value_parser = value_parser!(u64).range(1..=1_000_000))]
    pub events: Option<u64>,
    /// Seed of all chance in the dataset [default: the preset's]
    #[arg(long, value_name = "S")]
    pub seed: Option<u64>,
    /// Folder for the dataset; new, empty, or of this very run [default: out/PRESET-seedS]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Make no videos and no page, for training data
    #[arg(long)]
    pub no_video: bool,
    /// Make only the events K, K + N, K + 2 N … of the dataset, to be merged with the other shards by merge
    #[arg(long, value_name = "K/N", value_parser = shard)]
    pub shard: Option<(usize, usize)>,
    /// How the agents think.
    #[command(flatten)]
    pub effort: Effort,
    /// How many events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// Options of `verify`.
#[derive(Args, Debug)]
pub struct Verify {
    /// Folder of a finished dataset
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// How many files at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// Options of `merge`.
#[derive(Args, Debug)]
pub struct Merge {
    /// The folders of all shards, in any order
    #[arg(value_name = "DIR", required = true)]
    pub shards: Vec<PathBuf>,
    /// Folder for the dataset; new, empty, or of this very merge
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

/// Options of `splits`.
#[derive(Args, Debug)]
pub struct Splits {
    /// The folder of a dataset, or a file in the format phase-events/1
    #[arg(value_name = "DIR|FILE")]
    pub events: PathBuf,
    /// Check this split (phase-splits/1) instead of the dataset's own
    #[arg(long, value_name = "FILE", conflicts_with = "make")]
    pub splits: Option<PathBuf>,
    /// Divide the events and write the split (phase-splits/1) here
    #[arg(long, value_name = "FILE")]
    pub make: Option<PathBuf>,
    /// Seed of what the rules leave open, with --make
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
}

/// Options of `stats`.
#[derive(Args, Debug)]
pub struct Stats {
    /// The folder of a dataset
    #[arg(value_name = "DIR")]
    pub dataset: PathBuf,
    /// Also write the figures and plots (SVG) into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// Options of `simulate`.
#[derive(Args, Debug)]
pub struct Simulate {
    /// File in the format phase-events/1
    #[arg(long, value_name = "FILE")]
    pub events: PathBuf,
    /// Only the event with this id; may be given several times
    #[arg(long, value_name = "ID")]
    pub id: Vec<String>,
    /// Seed of all chance in the simulations
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

/// Options of `render`.
#[derive(Args, Debug)]
pub struct Render {
    /// An event file (phase-events/1) or the folder of a dataset
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Only the event with this id; may be given several times
    #[arg(long, value_name = "ID")]
    pub id: Vec<String>,
    /// Folder for the results, or for a single event a file ending in .mp4 (.png with --contact-sheet)
    #[arg(long, value_name = "DIR|FILE", default_value = "out/render")]
    pub out: PathBuf,
    /// Draw too what agent 0 or 1 sees and believes, and write below why it acts as it does (simulated events only)
    #[arg(long, value_name = "AGENT", value_parser = agent())]
    pub belief: Option<AgentId>,
    /// Instead of a video, one picture of N frames spread evenly over the event
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=100))]
    pub contact_sheet: Option<u16>,
    /// How many events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// Options of `check-physics`; at least one of the three files is needed.
#[derive(Args, Debug)]
pub struct CheckPhysics {
    /// File of probes: a few steps of one effect each
    #[arg(long, value_name = "FILE")]
    pub probes: Option<PathBuf>,
    /// File of runs: many steps of everything
    #[arg(long, value_name = "FILE")]
    pub runs: Option<PathBuf>,
    /// File in the format phase-events/1; its events with recovered actions are replayed
    #[arg(long, value_name = "FILE")]
    pub events: Option<PathBuf>,
    /// The engine to check
    #[arg(long, value_name = "ENGINE", default_value = Engine::World.name(), value_parser = engines())]
    pub engine: Engine,
    /// Also write the numbers into this file
    #[arg(long, value_name = "OUT")]
    pub json: Option<PathBuf>,
}

/// Options of `check-behaviour`.
#[derive(Args, Debug)]
pub struct CheckBehaviour {
    /// Also write the report, as JSON, here
    #[arg(long, value_name = "OUT")]
    pub json: Option<PathBuf>,
    /// Only these rows of the table in docs/behaviour.md
    #[arg(long, value_name = "N", num_args = 1.., value_parser = value_parser!(u8).range(1..=10))]
    pub row: Vec<u8>,
    /// Events of each scene: seeds 1 to N, which take the five mirrors in turn
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = value_parser!(u16).range(1..=10_000))]
    pub seeds: u16,
    /// Folder for report and contact sheets; new, empty, or of such a check, whose results are replaced
    #[arg(long, value_name = "DIR", default_value = "out/behaviour")]
    pub out: PathBuf,
    /// Folder with the scenes [default: data/behaviour of the source]
    #[arg(long, value_name = "DIR")]
    pub scenes: Option<PathBuf>,
    /// How the agents think.
    #[command(flatten)]
    pub effort: Effort,
    /// How many events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

impl CheckBehaviour {
    /// The folder with the scenes.
    #[must_use]
    pub fn scenes(&self) -> PathBuf {
        self.scenes.clone().unwrap_or_else(crate::check_behaviour::default_scenes)
    }
}

/// How many events at once.
#[derive(Args, Clone, Debug)]
pub struct Jobs {
    /// Events to work on at once; results do not depend on it [default: all cores]
    #[arg(long, value_name = "J", value_parser = value_parser!(u16).range(1..=1024))]
    pub jobs: Option<u16>,
}

/// What events play in, how long they last and how hard agents think; the defaults are the paper's.
#[derive(Args, Debug)]
pub struct Effort {
    /// Physics that the events themselves play in: `world` (rapier2d) or `forward` (the kernel that agents
    /// imagine with, nearest to the published simulator) [default: world]
    #[arg(long, value_name = "ENGINE", hide_possible_values = true, value_parser = engines())]
    pub engine: Option<Engine>,
    /// How exactly agents work out the futures they imagine: `coarse` or `exact`, which takes several times as
    /// long [default: coarse]
    #[arg(long, value_name = "HOW", hide_possible_values = true, value_parser = foresights())]
    pub foresight: Option<Foresight>,
    /// Belief particles of each agent [default: 50]
    #[arg(long, value_name = "K", value_parser = value_parser!(u32).range(1..=100_000))]
    pub particles: Option<u32>,
    /// POMCP simulations a decision [default: 1000]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=10_000_000))]
    pub simulations: Option<u32>,
    /// Longest an event may last, in steps of 0.25 s [default: 100]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=10_000))]
    pub max_steps: Option<u32>,
}

impl Effort {
    /// The settings asked for.
    #[must_use]
    pub fn settings(&self) -> Settings {
        let mut settings = Settings { engine: self.engine.unwrap_or_default(), ..Settings::default() };
        if let Some(foresight) = self.foresight {
            settings.minds.foresight = foresight;
        }
        if let Some(particles) = self.particles {
            settings.minds.particles = particles as usize;
        }
        if let Some(simulations) = self.simulations {
            settings.minds.simulations = simulations as usize;
        }
        if let Some(steps) = self.max_steps {
            settings.max_steps = steps as usize;
        }
        settings
    }

    /// The options as they were given, to repeat the command.
    #[must_use]
    pub fn as_given(&self) -> String {
        let options =
            [("particles", self.particles), ("simulations", self.simulations), ("max-steps", self.max_steps)];
        let engine = self.engine.map(|engine| format!(" --engine {}", engine.name()));
        let foresight = self.foresight.map(|foresight| format!(" --foresight {}", foresight.name()));
        let given = options.into_iter().filter_map(|(name, value)| Some(format!(" --{name} {}", value?)));
        engine.into_iter().chain(foresight).chain(given).collect()
    }
}

/// An agent by its number.
fn agent() -> impl TypedValueParser<Value = AgentId> {
    value_parser!(u8).range(0..=1).try_map(AgentId::try_from)
}

/// Reads a shard such as `3/16`.
fn shard(text: &str) -> Result<(usize, usize), String> {
    let numbers = text.split_once('/').and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
    match numbers {
        Some((k, n)) if 1 <= k && k <= n => Ok((k, n)),
        _ => Err("a shard is K/N with K from 1 to N, such as 3/16".into()),
    }
}

/// Reads an engine by its name.
fn engines() -> impl TypedValueParser<Value = Engine> {
    let names = PossibleValuesParser::new(Engine::ALL.map(Engine::name));
    names.try_map(|name| Engine::ALL.into_iter().find(|engine| engine.name() == name).ok_or("no such engine"))
}

/// Reads by its name how exactly to imagine.
fn foresights() -> impl TypedValueParser<Value = Foresight> {
    let names = PossibleValuesParser::new(Foresight::ALL.map(Foresight::name));
    names.try_map(|name| {
        Foresight::ALL.into_iter().find(|foresight| foresight.name() == name).ok_or("no such foresight")
    })
}

/// What is wrong with a command line, on one line; the whole help for a line without a command.
#[must_use]
pub fn one_sentence(error: &clap::Error) -> String {
    let text = error.render().to_string();
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return text;
    }
    let paragraphs = text.split("\n\n");
    let about_it = paragraphs.take_while(|part| !part.starts_with("Usage") && !part.starts_with("For more"));
    let lines = about_it.map(|part| part.split_whitespace().collect::<Vec<_>>().join(" "));
    format!("{} (--help lists the options)", lines.collect::<Vec<_>>().join("; "))
}
