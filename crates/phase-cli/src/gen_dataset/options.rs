//! The options of `gen-dataset` and `merge`.

use crate::{
    effort::SimulationOptions, look::LookOptions, named::named, output::Output, parallel::Jobs,
    shard_option::shard,
};
use chrono::NaiveDate;
use clap::{Args, value_parser};
use phase_dataset::form::StimulusForm;
use phase_model::setting::EVENTS;
use phase_runs::gen_dataset::{Generation, steps_of};
use phase_sampler::Starts;
use std::path::PathBuf;

/// Options of `gen-dataset`.
#[derive(Args, Debug)]
pub struct GenDataset {
    /// Dataset to generate: demo (twelve events, two of each kind, without selection), phase-500 (the paper's
    /// composition, selected), phase-500-v1 (the first edition's), phase-training (as many training events of
    /// the same kind as requested), phase-pairs (sets that differ in one social variable), phase-beliefs
    /// (pairs of a false and a true belief), phase-minds (agents that do not know each other's goals), or a
    /// file in the format phase-preset/3 whose name ends in .json
    #[arg(long, default_value = "demo")]
    pub preset: String,
    /// Number of events, 1 to 1000000 [default: the preset's]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(EVENTS.bounds()))]
    pub events: Option<u32>,
    /// Random seed of the dataset [default: the preset's]
    #[arg(long, value_name = "S")]
    pub seed: Option<u64>,
    /// Folder for the dataset; new, empty, or of the same run [default: out/PRESET-seedS]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Write no videos and no page, for training data
    #[arg(long, conflicts_with_all = ["palette", "size", "frame_rate"])]
    pub no_video: bool,
    /// Length of every event, 1 to 2500 seconds of video, a multiple of 0.25 [default: the preset's
    /// rule]
    #[arg(long, value_name = "S", value_parser = seconds)]
    pub seconds: Option<u32>,
    /// Places of bodies at the start: near the points of a grid, or on them, as in the published recordings
    #[arg(long, value_name = "PLACES", default_value = "near",
        value_parser = named(Starts::ALL, Starts::name))]
    pub starts: Starts,
    /// Look of the videos.
    #[command(flatten)]
    pub look: LookOptions,
    /// The date of publication in croissant.json, YYYY-MM-DD [default: none, so that every run makes the same
    /// bytes]
    #[arg(long, value_name = "DATE", value_parser = date)]
    pub date_published: Option<String>,
    /// Generate only the events K, K + N, K + 2 N … of the dataset, to be combined with the other shards by
    /// merge. In a task of a job array K may be `auto`: --shard auto/N under Slurm, Kubernetes (indexed
    /// jobs) and HyperQueue, or --shard auto for a whole Slurm array
    #[arg(long, value_name = "K/N", value_parser = shard)]
    pub shard: Option<(usize, usize)>,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
    /// Parameters of the agents.
    #[command(flatten)]
    pub effort: SimulationOptions,
    /// Number of threads.
    #[command(flatten)]
    pub jobs: Jobs,
}

impl From<&GenDataset> for Generation {
    fn from(options: &GenDataset) -> Self {
        Self {
            preset: options.preset.clone(),
            events: options.events.map(|events| events as usize),
            seed: options.seed,
            out: options.out.clone(),
            videos: !options.no_video,
            date_published: options.date_published.clone(),
            form: StimulusForm {
                steps: options.seconds,
                size: options.look.size,
                palette: options.look.palette.name().into(),
                frame_rate: options.look.frame_rate,
                starts: options.starts,
            },
            shard: options.shard,
            effort: options.effort.effort(),
            threads: options.jobs.given(),
        }
    }
}

/// Options of `merge`.
#[derive(Args, Debug)]
pub struct Merge {
    /// The folders of all shards, in any order
    #[arg(value_name = "DIR", required = true)]
    pub shards: Vec<PathBuf>,
    /// Folder for the dataset; new, empty, or of the same merge
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Reads a time as a number of steps.
fn seconds(text: &str) -> Result<u32, String> {
    steps_of(text).ok_or_else(|| "must be 1 to 2500, a multiple of 0.25".into())
}

/// Reads a date.
fn date(text: &str) -> Result<String, String> {
    let date = NaiveDate::parse_from_str(text, "%Y-%m-%d").ok();
    let date = date.filter(|date| date.to_string() == text);
    date.map(|date| date.to_string()).ok_or_else(|| "a date is YYYY-MM-DD, such as 2026-11-23".into())
}
