//! The options of `study`.

use crate::output::Output;
use clap::{Args, Subcommand, builder::PossibleValuesParser, value_parser};
use phase_model::setting::EVENTS;
use std::path::PathBuf;

/// The experiments whose numbers a new study takes over.
const EXPERIMENTS: [&str; 3] = ["experiment-1", "experiment-2", "relations"];

/// Command of `study` to carry out.
#[derive(Subcommand, Debug)]
pub enum Study {
    /// Write the configuration of a study of some videos, with comments
    New(NewStudy),
    /// Check a configuration, and that all of its videos are there
    Check(CheckStudy),
    /// Export the answers of a study as a Psych-DS dataset, and as phase-ratings/1 for eval
    Export(ExportStudy),
    /// Analyse the answers of a study: agreement, accuracies, human-likeness, interactions
    Report(ReportStudy),
    /// Copy the answers of a study, at any time
    Backup(BackupStudy),
    /// Count the relations that people named in jsPsych, as phase-ratings/1 for eval and rdm
    Ratings(CountRatings),
}

/// Options of `study new`.
#[derive(Args, Debug)]
pub struct NewStudy {
    /// Whose form and numbers to take over: the paper's experiment-1 (types of interaction) or experiment-2
    /// (goals, relation and human-likeness), or the relations of Malik and Isik 2023
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(EXPERIMENTS))]
    pub experiment: String,
    /// Folder with videos, a finished dataset or .mp4 files; SOURCE, such as phase or human, distinguishes
    /// folders [default source: phase]. Videos that do not lie below the folder of --out are copied there
    #[arg(long, value_name = "[SOURCE=]DIR", required = true)]
    pub videos: Vec<String>,
    /// File in the format phase-events/1 with the events that .mp4 files show, for their labels
    #[arg(long, value_name = "FILE")]
    pub events: Vec<PathBuf>,
    /// Take this many videos of each folder, 1 to 1000000, at random [default: all]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(EVENTS.bounds()))]
    pub sample: Option<u32>,
    /// Make a video a catch trial: its id, and the relation or type of interaction that everybody sees in it
    #[arg(long = "catch", value_name = "ID=ANSWER")]
    pub catch_trials: Vec<String>,
    /// Name of the study, part of its address: small letters, digits and - [default: the experiment's]
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// Videos for each rater, 1 to 1000000 [default: all, or of 100 and more the experiment's number]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(EVENTS.bounds()))]
    pub videos_per_rater: Option<u32>,
    /// Show no rater two videos of one set, such as both events of a minimal pair
    #[arg(long)]
    pub one_of_each_set: bool,
    /// Seed of assignments and of --sample, 0 to 9223372036854775807
    #[arg(
        long,
        value_name = "S",
        default_value_t = 1,
        value_parser = value_parser!(u64).range(..=i64::MAX as u64)
    )]
    pub seed: u64,
    /// File for the configuration, which must not exist; its folder is made
    #[arg(long, value_name = "FILE", default_value = "study.json")]
    pub out: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Options of `study check`.
#[derive(Args, Debug)]
pub struct CheckStudy {
    /// The configuration (phase-study/1)
    #[arg(value_name = "FILE")]
    pub config: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Options of `study export`.
#[derive(Args, Debug)]
pub struct ExportStudy {
    /// The configuration (phase-study/1)
    #[arg(value_name = "FILE")]
    pub config: PathBuf,
    /// The file with the answers (.sqlite), or the folder of the server, which has it by the study's name
    #[arg(long, value_name = "FILE|DIR")]
    pub answers: PathBuf,
    /// Folder for the dataset; new or empty
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Also export with which members of the address raters came, such as their Prolific ids
    #[arg(long)]
    pub external_ids: bool,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Options of `study report`.
#[derive(Args, Debug)]
pub struct ReportStudy {
    /// The configuration (phase-study/1)
    #[arg(value_name = "FILE")]
    pub config: PathBuf,
    /// The file with the answers (.sqlite), or the folder of the server, which has it by the study's name
    #[arg(long, value_name = "FILE|DIR")]
    pub answers: PathBuf,
    /// Folder for the report
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Options of `study backup`.
#[derive(Args, Debug)]
pub struct BackupStudy {
    /// The file with the answers (.sqlite), as the server keeps it
    #[arg(value_name = "FILE")]
    pub answers: PathBuf,
    /// File for the copy; it must not exist
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Options of `study ratings`.
#[derive(Args, Debug)]
pub struct CountRatings {
    /// Data of jsPsych with trials of the plugin phase-rating, one file a participant: JSON or CSV; or JSON
    /// with the array of each participant in a line
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Catch trials (those with `expected`) that a participant who counts may fail, 0 to 1000
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = value_parser!(u32).range(0..=1000))]
    pub catch_failures_allowed: u32,
    /// File for the ratings
    #[arg(long, value_name = "FILE", default_value = "ratings.json")]
    pub out: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}
