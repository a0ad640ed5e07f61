//! The options of `benchmark`.

use crate::{eval::options::Parts, named::named, output::Output, parallel::Jobs};
use clap::{Args, builder::PossibleValuesParser, value_parser};
use phase_minds::MindKind;
use phase_runs::benchmark::{BenchmarkRun, SEED, plan::METHODS};
use std::path::PathBuf;

/// Options of `benchmark`.
#[derive(Args, Debug)]
pub struct Benchmark {
    /// Folder of a finished dataset that is divided; methods are evaluated on its test events
    #[arg(long, value_name = "DIR")]
    pub data: PathBuf,
    /// Also evaluate on these recordings (a phase-events/1 file, or a folder of events)
    #[arg(long, value_name = "FILE|DIR")]
    pub real: Option<PathBuf>,
    /// Ratings by people of the relations of the recordings (phase-ratings/1; see
    /// docs/reference/formats/studies.md)
    #[arg(long, value_name = "FILE", requires = "real")]
    pub ratings: Option<PathBuf>,
    /// Also evaluate goals on this dataset of sets, such as phase-pairs; not the variants of SIMPLE and not
    /// --trained
    #[arg(long, value_name = "DIR")]
    pub pairs: Option<PathBuf>,
    /// Only these methods, such as simple,arg,stgat [default: all]
    #[arg(
        long,
        value_name = "METHODS",
        value_delimiter = ',',
        value_parser = PossibleValuesParser::new(METHODS)
    )]
    pub methods: Vec<String>,
    /// Minds that SIMPLE imagines, and no others: `phase`, or `published`, those of the published simulator,
    /// with bodies that turn one way in recordings [default: `simple` averages over both, `simple-published`
    /// has published minds, the other variants ours]
    #[arg(long, value_name = "MINDS", hide_possible_values = true,
        value_parser = named(MindKind::ALL, MindKind::name))]
    pub minds: Option<MindKind>,
    /// Also evaluate networks with these weights, as `train` writes them, and show how they improve with the
    /// amount of training data
    #[arg(long, value_name = "FILES", num_args = 1..)]
    pub trained: Vec<PathBuf>,
    /// Also show these results.json of `eval`, of the same events
    #[arg(long, value_name = "FILES", num_args = 1..)]
    pub results: Vec<PathBuf>,
    /// Only the first N events of each, 1 to 1000000000
    #[arg(long, value_name = "N", value_parser = value_parser!(u64).range(1..=1_000_000_000))]
    pub limit: Option<u64>,
    /// Random seed of methods and intervals
    #[arg(long, value_name = "S", default_value_t = SEED)]
    pub seed: u64,
    /// Folder with a folder for each method and task, as `eval` leaves them; finished evaluations are not
    /// repeated
    #[arg(long, value_name = "DIR", default_value = "out/eval")]
    pub evaluations: PathBuf,
    /// Folder for the report; new, empty, or of a benchmark, which is overwritten
    #[arg(long, value_name = "DIR", default_value = "out/benchmark")]
    pub out: PathBuf,
    /// Also write the figures that documents show, a row on each line; `cargo xtask results` makes pages of
    /// them
    #[arg(long, value_name = "FILE", conflicts_with = "shard")]
    pub figures: Option<PathBuf>,
    /// Part of the events, and the parts that are merged.
    #[command(flatten)]
    pub parts: Parts,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
    /// Number of events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

impl From<&Benchmark> for BenchmarkRun {
    fn from(options: &Benchmark) -> Self {
        Self {
            data: options.data.clone(),
            real: options.real.clone(),
            ratings: options.ratings.clone(),
            pairs: options.pairs.clone(),
            methods: options.methods.clone(),
            minds: options.minds,
            trained: options.trained.clone(),
            results: options.results.clone(),
            limit: options.limit.map(|limit| limit as usize),
            seed: options.seed,
            evaluations: options.evaluations.clone(),
            out: options.out.clone(),
            figures: options.figures.clone(),
            shard: options.parts.shard,
            merge: options.parts.merge.clone(),
            threads: options.jobs.given(),
        }
    }
}
