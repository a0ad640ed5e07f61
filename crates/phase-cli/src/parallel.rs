//! The option `--jobs`: how many events at once.

use clap::{Args, value_parser};
use phase_model::setting::THREADS;

/// Number of events at once.
#[derive(Args, Clone, Debug)]
pub struct Jobs {
    /// Events to work on at once, 1 to 1024; results do not depend on it [default: all cores]
    #[arg(long, value_name = "J", value_parser = value_parser!(u16).range(THREADS.bounds()))]
    pub jobs: Option<u16>,
}

impl Jobs {
    /// The number that was given.
    #[must_use]
    pub fn given(&self) -> Option<usize> {
        self.jobs.map(usize::from)
    }

    /// The number of threads: that of this machine's cores, if none was given.
    #[must_use]
    pub fn threads(&self) -> usize {
        phase_runs::parallel::threads(self.given())
    }
}
