//! The command line from within Python.

use crate::error::{raise, raise_with_code};
use phase_cli::{PHASE, cli::Command, console::without_results, interrupt::leave_to_host, program};
use phase_runs::{
    interrupt,
    leaderboard::{Sealed, Submission},
    listener::Silent,
};
use pyo3::prelude::*;
use std::{ffi::OsString, path::PathBuf, thread, time::Duration};

/// Time between two questions to Python whether it was interrupted.
const POLL: Duration = Duration::from_millis(100);

/// Runs a command of `phase`, as from its command line without the program's name; with `silent` it prints
/// no results. An interruption of Python stops it as Ctrl-C does there: what is finished is kept.
#[pyfunction]
pub(crate) fn run(py: Python<'_>, arguments: Vec<OsString>, silent: bool) -> PyResult<()> {
    leave_to_host();
    let arguments = core::iter::once(OsString::from("phase")).chain(arguments);
    let command = move || program::run_with::<Command>(PHASE, arguments);
    let command = move || if silent { without_results(command) } else { command() };
    // A pool of its own: the one that all of a process share has no threads in a forked child.
    let pool = rayon::ThreadPoolBuilder::new().build().map_err(raise)?;
    let worker = thread::spawn(move || pool.install(command));
    let mut interrupted = None;
    while !worker.is_finished() {
        py.detach(|| thread::sleep(POLL));
        if let Err(error) = py.check_signals() {
            interrupt::request();
            interrupted = Some(error);
        }
    }
    let outcome = worker.join();
    if let Some(error) = interrupted {
        // The request was for every run of this process; another that ends by it must not forget it.
        interrupt::clear();
        return Err(error);
    }
    match outcome {
        Ok(result) => result.map_err(|failure| raise_with_code(failure.sentence, failure.exit_code)),
        Err(_) => Err(raise("the command failed; this is a defect of PHASE")),
    }
}

/// Checks and scores a file of predictions, and writes the files of a pull request for the leaderboard; its
/// scores and files as JSON. `PhaseError` if anything is invalid or cannot be written.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "Python passes them one by one")]
pub(crate) fn submit(
    py: Python<'_>,
    predictions: PathBuf,
    events: PathBuf,
    method: String,
    by: String,
    source: String,
    out: PathBuf,
    sealed: Option<PathBuf>,
    questions: Option<PathBuf>,
) -> PyResult<String> {
    let sealed = sealed.map(|published| Sealed { published, questions });
    let submission = Submission { predictions, events, sealed, method: Some(method), by, source, out };
    let pool = rayon::ThreadPoolBuilder::new().build().map_err(raise)?;
    let submitted = py.detach(|| pool.install(|| submission.submit(&Silent))).map_err(raise)?;
    serde_json::to_string(&submitted).map_err(raise)
}
