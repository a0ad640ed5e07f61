//! Many events at once, with results in order.

use crate::{cli::Jobs, error::CliError, interrupt};
use rayon::{
    ThreadPoolBuilder,
    iter::{IntoParallelIterator, ParallelIterator},
};
use std::sync::atomic::{AtomicBool, Ordering};

/// Makes `count` things on as many threads as asked for. `make` returns `None` when it was interrupted; then,
/// and after the first failure, no new thing is begun.
///
/// # Errors
/// The failure of the thing with the lowest number, or [`CliError::Threads`]. `Ok(None)` means interrupted.
pub fn make_all<T: Send>(
    jobs: &Jobs,
    count: usize,
    make: impl Fn(usize) -> Result<Option<T>, CliError> + Sync,
) -> Result<Option<Vec<T>>, CliError> {
    let cores = std::thread::available_parallelism().map_or(1, Into::into);
    let threads = jobs.jobs.map_or(cores, usize::from).min(count.max(1));
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| CliError::Threads { jobs: threads, reason: error.to_string() })?;
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
