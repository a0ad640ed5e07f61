//! Methods that perceive events: goals and relations, and what comes next.

use crate::{error::raise, observed::Observed};
use core::ops::ControlFlow;
use phase_eval::goals::Answer;
use phase_model::json::parse_text;
use phase_runs::{
    effort::MindChoice,
    eval::{compare, methods as named, networks},
};
use pyo3::prelude::*;
use serde_json::json;
use std::sync::Arc;

/// Runs a computation without the interpreter's lock, and stops it when Python has a signal to handle.
///
/// # Errors
/// The exception of the signal.
pub(crate) fn interruptible<T: Send>(
    py: Python<'_>,
    compute: impl Send + FnOnce(&mut dyn FnMut() -> ControlFlow<()>) -> T,
) -> PyResult<T> {
    let mut interrupted = None;
    let done = py.detach(|| {
        compute(&mut || match Python::attach(|py| py.check_signals()) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                interrupted = Some(error);
                ControlFlow::Break(())
            }
        })
    });
    interrupted.map_or(Ok(done), Err)
}

/// Infers goals and relation from what was seen of an event; the answer as JSON. `PhaseError` for an unknown
/// method, and for an event without motion.
#[pyfunction]
pub(crate) fn infer(
    py: Python<'_>,
    observed: PyRef<'_, Observed>,
    method: &str,
    seed: u64,
) -> PyResult<String> {
    let observed = Arc::clone(&observed.event);
    let recogniser = named::recogniser(method, None, &MindChoice::default()).map_err(raise)?;
    let judged = interruptible(py, |tick| {
        let judged = recogniser.judge(&observed, seed, tick);
        judged.map_err(|error| error.to_string())
    })?;
    let judged = judged.map_err(raise)?;
    let (judgement, details) = judged.ok_or_else(|| raise("interrupted"))?;
    let answer = Answer::of(&judgement).map_err(raise)?;
    serde_json::to_string(&json!({ "answer": answer, "details": details })).map_err(raise)
}

/// Predicts the next steps after what was seen of an event; the answer as JSON, positions in u. `PhaseError`
/// for an unknown method.
#[pyfunction]
pub(crate) fn forecast(
    py: Python<'_>,
    observed: PyRef<'_, Observed>,
    method: &str,
    steps: usize,
    seed: u64,
) -> PyResult<String> {
    let observed = Arc::clone(&observed.event);
    let forecaster = named::forecaster(method, None, &MindChoice::default()).map_err(raise)?;
    let found = interruptible(py, |tick| {
        let found = forecaster.forecast(&observed, steps, seed, tick);
        found.map_err(|error| error.to_string())
    })?;
    let (prediction, details) = found.map_err(raise)?.ok_or_else(|| raise("interrupted"))?;
    let paths = |forecast: &phase_model::Forecast| -> Vec<Vec<[f32; 2]>> {
        forecast.iter().map(|path| path.iter().map(|place| place.to_array()).collect()).collect()
    };
    let futures: Vec<_> = prediction.samples.iter().map(paths).collect();
    let answer = json!({ "forecast": paths(&prediction.forecast), "futures": futures, "details": details });
    serde_json::to_string(&answer).map_err(raise)
}

/// The names of the methods for `infer`, and of those for `forecast`, that this build has.
#[pyfunction]
pub(crate) fn methods() -> (Vec<&'static str>, Vec<&'static str>) {
    let built = |name: &&'static str| networks::INCLUDED || !networks::is_network(name);
    let [goals, trajectories] = [named::recognisers(), named::FORECASTERS.to_vec()];
    (goals.into_iter().filter(built).collect(), trajectories.into_iter().filter(built).collect())
}

/// Scores of one method less those of another on the same events, from the results of both at a task, as
/// JSON. `PhaseError` for results that are none, and of other events.
#[pyfunction]
#[pyo3(name = "compare")]
pub(crate) fn compare_results(
    py: Python<'_>,
    task: &str,
    one: &str,
    other: &str,
    seed: u64,
) -> PyResult<String> {
    let parsed = |results| parse_text(results).map_err(|error| error.to_string());
    let difference = py.detach(|| compare::difference(task, parsed(one)?, parsed(other)?, seed));
    difference.map(|difference| difference.to_string()).map_err(raise)
}
