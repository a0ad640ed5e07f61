//! Pools of threads, which a forked process makes anew.
//!
//! A fork copies the process with one thread: in the child a pool of the parent has no threads any more, and
//! a caller that gave it work would wait for ever.

use crate::error::raise;
use phase_model::setting::THREADS;
use pyo3::prelude::*;
use rayon::ThreadPool;
use std::{
    collections::BTreeMap,
    process,
    sync::{Arc, Mutex, PoisonError},
};

/// The pools of one process, by their numbers of threads.
struct Pools {
    process: u32,
    by_threads: BTreeMap<usize, Arc<ThreadPool>>,
}

/// Only the holder of the interpreter's lock locks it, and a process forks while it holds that lock. So it is
/// free in every child.
static POOLS: Mutex<Pools> = Mutex::new(Pools { process: 0, by_threads: BTreeMap::new() });

/// Checks a number of threads.
///
/// # Errors
/// `PhaseError`, if it is not in the range [`THREADS`].
pub(crate) fn check_threads(threads: usize) -> PyResult<()> {
    THREADS.check_count(threads).map(|_| ()).map_err(raise)
}

/// The pool of a number of threads in this process.
///
/// # Errors
/// `PhaseError`, if the number is out of range or the system has not that many threads.
pub(crate) fn pool(_: Python<'_>, threads: usize) -> PyResult<Arc<ThreadPool>> {
    check_threads(threads)?;
    let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    if pools.process != process::id() {
        // To drop a pool is to talk to its threads, which are not there.
        core::mem::forget(core::mem::take(&mut pools.by_threads));
        pools.process = process::id();
    }
    if let Some(pool) = pools.by_threads.get(&threads) {
        return Ok(Arc::clone(pool));
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = Arc::new(pool.map_err(|error| raise(format!("threads: {error}")))?);
    pools.by_threads.insert(threads, Arc::clone(&pool));
    Ok(pool)
}
