//! Methods that perceive events: goals and relations, and what comes next.

use crate::{error::raise, event::Event};
use core::ops::ControlFlow;
use phase_eval::goals::Answer;
use phase_event::ObservedEvent;
use phase_runs::{effort::MindChoice, eval::methods as named};
use pyo3::prelude::*;
use serde_json::json;

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

/// The steps of an event that are watched.
///
/// # Errors
/// `PhaseError` for an event of which nothing can be seen.
pub(crate) fn observed(event: &Event, steps: Option<usize>) -> PyResult<ObservedEvent> {
    let observed = event.recording.observed().map_err(raise)?;
    Ok(steps.map_or_else(|| observed.clone(), |steps| observed.prefix(steps)))
}

/// Infers goals and relation of an event from its trajectories, or from the first `steps` steps of them; the
/// answer as JSON. `PhaseError` for an unknown method, and for an event without motion.
#[pyfunction]
#[pyo3(signature = (event, method, seed, steps))]
pub(crate) fn infer(
    py: Python<'_>,
    event: PyRef<'_, Event>,
    method: &str,
    seed: u64,
    steps: Option<usize>,
) -> PyResult<String> {
    let observed = observed(&event, steps)?;
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

/// Predicts the next steps of an event of which `watched` steps are known; the answer as JSON, positions in
/// u. `PhaseError` for an unknown method.
#[pyfunction]
pub(crate) fn forecast(
    py: Python<'_>,
    event: PyRef<'_, Event>,
    method: &str,
    watched: usize,
    steps: usize,
    seed: u64,
) -> PyResult<String> {
    let observed = observed(&event, Some(watched))?;
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

/// The names of the methods for `infer`, and of those for `forecast`.
#[pyfunction]
pub(crate) fn methods() -> (Vec<&'static str>, Vec<&'static str>) {
    (named::recognisers(), named::FORECASTERS.to_vec())
}
