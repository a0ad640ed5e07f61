//! The options of `fit-reports`.

use clap::{Args, value_parser};
use std::path::PathBuf;

/// Options of `fit-reports`.
#[derive(Args, Debug)]
pub struct FitReports {
    /// Results of `eval goals --method simple --ratings FILE` (results.json), which hold SIMPLE's impression
    /// of every event and how people rated it
    #[arg(long, value_name = "FILE")]
    pub results: PathBuf,
    /// Parts into which the events are divided; each is held out of one fit
    #[arg(long, value_name = "K", default_value_t = 10, value_parser = value_parser!(u16).range(2..=1000))]
    pub folds: u16,
    /// File for the model fitted to all events (JSON)
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// File for the record of the fit (JSON): to which events, and how the reports agree with ratings, also
    /// with those held out
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,
    /// The seed of the division into folds and of the intervals
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
}
