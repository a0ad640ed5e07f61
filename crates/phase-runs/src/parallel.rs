//! Many events at once, with results in order.

use crate::{error::RunError, interrupt};
use rayon::ThreadPoolBuilder;
use std::{
    collections::BTreeMap,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
};

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
    let next = AtomicUsize::new(0);
    let failed = AtomicBool::new(false);
    let results: Mutex<BTreeMap<usize, Result<Option<T>, RunError>>> = Mutex::default();
    // One at a time and in order, so that no thread waits while there is something to begin.
    let work = || {
        while !failed.load(Ordering::Relaxed) && !interrupt::requested() {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= count {
                return;
            }
            let result = make(index);
            if result.is_err() {
                failed.store(true, Ordering::Relaxed);
            }
            results.lock().unwrap_or_else(PoisonError::into_inner).insert(index, result);
        }
    };
    let threads = threads.min(count.max(1));
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|source| RunError::Threads { jobs: threads, source })?;
    pool.broadcast(|_| work());
    let results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    // Failures first: an interruption that follows from one must not hide it.
    let mut made = Vec::with_capacity(count);
    for result in results.into_values() {
        made.extend(result?);
    }
    Ok((made.len() == count).then_some(made))
}
