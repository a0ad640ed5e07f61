//! Many events at once, with results in order.

use crate::{error::RunError, interrupt};
use rayon::{
    ThreadPool, ThreadPoolBuilder,
    iter::{IntoParallelIterator, ParallelIterator},
};
use std::sync::atomic::{AtomicBool, Ordering};

/// A number of threads, or without one that of this machine's cores.
#[must_use]
pub fn threads(number: Option<usize>) -> usize {
    number.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, Into::into))
}

/// Makes `count` items on a number of threads. `make` returns `None` when it was interrupted;
/// then, and after the first failure, no new item is begun.
///
/// # Errors
/// The failure of the item with the lowest number, or [`RunError::Threads`]. `Ok(None)` means interrupted.
pub fn make_all<T: Send>(
    threads: usize,
    count: usize,
    make: impl Fn(usize) -> Result<Option<T>, RunError> + Sync,
) -> Result<Option<Vec<T>>, RunError> {
    let pool = pool(threads.min(count.max(1)))?;
    let failed = AtomicBool::new(false);
    let results: Vec<Result<Option<T>, RunError>> = pool.install(|| {
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
/// [`RunError::Threads`].
pub(crate) fn on_threads(threads: usize, work: impl Fn() + Sync) -> Result<(), RunError> {
    pool(threads)?.broadcast(|_| work());
    Ok(())
}

fn pool(threads: usize) -> Result<ThreadPool, RunError> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map_err(|source| RunError::Threads { jobs: threads, source })
}
