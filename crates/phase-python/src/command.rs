//! The command line from within Python.

use crate::error::raise;
use phase_cli::{PHASE, cli::Command, interrupt::leave_to_host, program};
use phase_runs::interrupt;
use pyo3::prelude::*;
use std::{ffi::OsString, thread, time::Duration};

/// Time between two questions to Python whether it was interrupted.
const POLL: Duration = Duration::from_millis(100);

/// Runs a command of `phase`, as from its command line without the program's name. An interruption of Python
/// stops it as Ctrl-C does there: what is finished is kept.
#[pyfunction]
pub(crate) fn run(py: Python<'_>, arguments: Vec<String>) -> PyResult<()> {
    leave_to_host();
    let arguments = core::iter::once("phase".to_owned()).chain(arguments).map(OsString::from);
    let worker = thread::spawn(move || program::run_with::<Command>(PHASE, arguments));
    let mut interrupted = None;
    while !worker.is_finished() {
        py.detach(|| thread::sleep(POLL));
        if let Err(error) = py.check_signals() {
            interrupt::request();
            interrupted = Some(error);
        }
    }
    let outcome = worker.join();
    interrupt::clear();
    if let Some(error) = interrupted {
        return Err(error);
    }
    match outcome {
        Ok(result) => result.map_err(|failure| raise(failure.sentence)),
        Err(_) => Err(raise("the command failed; this is a defect of PHASE")),
    }
}
