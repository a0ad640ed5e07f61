//! Many events at once, with results in order.

use crate::{error::CliError, interrupt};
use clap::{Args, value_parser};
use rayon::{
    ThreadPool, ThreadPoolBuilder,
    iter::{IntoParallelIterator, ParallelIterator},
};
use std::sync::atomic::{AtomicBool, Ordering};

/// Number of events at once.
#[derive(Args, Clone, Debug)]
pub struct Jobs {
    /// Events to work on at once; results do not depend on it [default: all cores]
    #[arg(long, value_name = "J", value_parser = value_parser!(u16).range(1..=1024))]
    pub jobs: Option<u16>,
}

impl Jobs {
    /// The number of threads.
    #[must_use]
    pub fn threads(&self) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, Into::into);
        self.jobs.map_or_else(cores, usize::from)
    }
}

/// Makes `count` items on the requested number of threads. `make` returns `None` when it was interrupted;
/// then, and after the first failure, no new item is begun.
///
/// # Errors
/// The failure of the item with the lowest number, or [`CliError::Threads`]. `Ok(None)` means interrupted.
pub fn make_all<T: Send>(
    jobs: &Jobs,
    count: usize,
    make: impl Fn(usize) -> Result<Option<T>, CliError> + Sync,
) -> Result<Option<Vec<T>>, CliError> {
    let pool = pool(jobs.threads().min(count.max(1)))?;
    let failed = AtomicBool::new(false);
    let results: Vec<Result<Option<T>, CliError>> = pool.install(|| {
        let one = |index| {
            if failed.load(Ordering::Relaxed) || interrupt::requested() {
                return Ok(None);
            }
            let result = make(index);
            if result.is_err() {
                failed.store(true, Ordering::Relaxed);
            }
            result
        };
        (0..count).into_par_iter().map(one).collect()
    });
    // Failures first: an interruption that follows from one must not hide it.
    let mut made = Vec::with_capacity(count);
    let mut interrupted = false;
    for result in results {
        match result? {
            Some(thing) => made.push(thing),
            None => interrupted = true,
        }
    }
    Ok((!interrupted).then_some(made))
}

/// Runs `work` once on each of a number of threads.
///
/// # Errors
/// [`CliError::Threads`].
pub fn on_threads(threads: usize, work: impl Fn() + Sync) -> Result<(), CliError> {
    pool(threads)?.broadcast(|_| work());
    Ok(())
}

fn pool(threads: usize) -> Result<ThreadPool, CliError> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map_err(|source| CliError::Threads { jobs: threads, source })
}
