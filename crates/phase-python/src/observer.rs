//! SIMPLE while an event is watched.

use crate::{
    arrays::{reading, rows},
    error::raise,
    observed::{Observed, ROW_COLUMNS, bodies, check_inside},
};
use core::ops::ControlFlow;
use numpy::PyArray2;
use phase_eval::goals::Answer;
use phase_simple::{Budget, Inference, Observer, Simple};
use pyo3::{PyTypeInfo, prelude::*};
use serde_json::json;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// SIMPLE while an event is watched, row by row. Users see it as `phase_events.Observer`.
///
/// A copy, also one that is pickled, watches everything again, which takes as long as before.
#[pyclass(frozen, name = "Observer", module = "phase_events._native")]
pub(crate) struct PythonObserver {
    simple: Simple,
    start: Py<Observed>,
    seed: u64,
    decisions: Option<usize>,
    watched: Mutex<Watched>,
    entities: usize,
}

/// An observer and what it was asked.
struct Watched {
    observer: Observer,
    asked: Vec<Asked>,
}

/// A row that was pushed; `None` for an inference.
type Asked = Option<Vec<[f32; ROW_COLUMNS]>>;

#[pymethods]
impl PythonObserver {
    /// Begins with the rows of an event that were seen before. [`push`](Self::push) simulates at most
    /// `decisions` decisions of minds for a row; the default is that of [`Budget`].
    #[new]
    fn new(
        py: Python<'_>,
        start: Bound<'_, Observed>,
        seed: u64,
        decisions: Option<usize>,
    ) -> PyResult<Self> {
        let observed = &start.get().event;
        let simple = Simple::bundled().map_err(raise)?;
        let mut observer = py.detach(|| simple.observer(observed, seed)).map_err(raise)?;
        if let Some(decisions) = decisions {
            observer.set_budget(Budget { decisions: Some(decisions) });
        }
        let entities = observed.entities().count();
        let watched = Mutex::new(Watched { observer, asked: Vec::new() });
        Ok(Self { simple, start: start.unbind(), seed, decisions, watched, entities })
    }

    /// The arguments of the constructor, and of `__setstate__`.
    #[allow(clippy::type_complexity)]
    fn __reduce__<'py>(
        &self,
        py: Python<'py>,
    ) -> (Bound<'py, PyAny>, (Py<Observed>, u64, Option<usize>), Vec<Asked>) {
        let arguments = (self.start.clone_ref(py), self.seed, self.decisions);
        (Self::type_object(py).into_any(), arguments, self.watched().asked.clone())
    }

    /// Watches again what was watched, and infers again what was inferred.
    fn __setstate__(&self, py: Python<'_>, asked: Vec<Asked>) -> PyResult<()> {
        py.detach(|| {
            let mut watched = self.watched();
            for one in asked {
                watched.ask(one)?;
            }
            Ok(())
        })
        .map_err(|error: String| raise(error))
    }

    /// Watches the next row, 0.25 s later, and answers with limited effort, as JSON. `PhaseError` for an
    /// invalid row.
    fn push(&self, py: Python<'_>, row: &Bound<'_, PyArray2<f32>>) -> PyResult<String> {
        let row = read_row(row, self.entities)?;
        self.answer(&py.detach(|| self.watched().ask(Some(row))).map_err(raise)?)
    }

    /// The answer of a batch inference of the rows seen so far, as JSON.
    fn inference(&self, py: Python<'_>) -> PyResult<String> {
        self.answer(&py.detach(|| self.watched().ask(None)).map_err(raise)?)
    }
}

impl Watched {
    fn ask(&mut self, asked: Asked) -> Result<Inference, String> {
        let inference = match &asked {
            Some(row) => self.observer.push(bodies(row)).map_err(|error| error.to_string())?,
            None => {
                let inference = self.observer.inference(&mut || ControlFlow::Continue(()));
                let inference = inference.map_err(|error| error.to_string())?;
                inference.ok_or_else(|| "interrupted".to_owned())?
            }
        };
        self.asked.push(asked);
        Ok(inference)
    }
}

impl PythonObserver {
    fn watched(&self) -> MutexGuard<'_, Watched> {
        self.watched.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn answer(&self, inference: &Inference) -> PyResult<String> {
        let answer = Answer::of(&self.simple.judgement(inference)).map_err(raise)?;
        serde_json::to_string(&json!({ "answer": answer })).map_err(raise)
    }
}

/// The numbers of a row, (entities, 5).
fn read_row(row: &Bound<'_, PyArray2<f32>>, entities: usize) -> PyResult<Vec<[f32; ROW_COLUMNS]>> {
    let row = reading("row", row, &[entities, ROW_COLUMNS])?;
    let numbers = rows(&row);
    let read = numbers.as_chunks().0.to_vec();
    check_inside(&bodies(&read)[..entities], |k| format!("row[{k}]"))?;
    Ok(read)
}
