//! Many events at once, with results in order.

use crate::{error::CliError, interrupt};
use clap::{Args, value_parser};
use rayon::{
    ThreadPool, ThreadPoolBuilder,
    iter::{IntoParallelIterator, ParallelIterator},
};
use std::sync::{
    Mutex, PoisonError,
    atomic::{AtomicBool, AtomicUsize, Ordering},
};

/// Number of events at once.
#[derive(Args, Clone, Debug)]
pub struct Jobs {
    /// Events to work on at once; results do not depend on it [default: all cores]
    #[arg(long, value_name = "J", value_parser = value_parser!(u16).range(1..=1024))]
    pub jobs: Option<u16>,
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
    let pool = pool(jobs, count)?;
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

/// Processes `count` items on the requested number of threads without results. `act` returns `None` when it
/// was interrupted; then, and after the first failure, no new item is begun. Returns whether all were done.
///
/// # Errors
/// The failure of the item with the lowest number of those that failed, or [`CliError::Threads`].
pub fn for_all(
    jobs: &Jobs,
    count: usize,
    act: impl Fn(usize) -> Result<Option<()>, CliError> + Sync,
) -> Result<bool, CliError> {
    let pool = pool(jobs, count)?;
    let (done, failure) = (AtomicUsize::new(0), Mutex::new(None::<(usize, CliError)>));
    let failed = || failure.lock().unwrap_or_else(PoisonError::into_inner);
    let one = |index| {
        if interrupt::requested() || failed().is_some() {
            return;
        }
        match act(index) {
            Ok(Some(())) => {
                done.fetch_add(1, Ordering::Relaxed);
            }
            Ok(None) => {}
            Err(error) => {
                let mut first = failed();
                if first.as_ref().is_none_or(|(number, _)| index < *number) {
                    *first = Some((index, error));
                }
            }
        }
    };
    // In order, one at a time for each thread, so that the finished items are nearly a prefix of all.
    let next = AtomicUsize::new(0);
    pool.broadcast(|_| {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= count {
                return;
            }
            one(index);
        }
    });
    match failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some((_, error)) => Err(error),
        None => Ok(done.into_inner() == count),
    }
}

fn pool(jobs: &Jobs, count: usize) -> Result<ThreadPool, CliError> {
    let cores = std::thread::available_parallelism().map_or(1, Into::into);
    let threads = jobs.jobs.map_or(cores, usize::from).min(count.max(1));
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map_err(|source| CliError::Threads { jobs: threads, source })
}
