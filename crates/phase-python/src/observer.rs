//! SIMPLE while an event is watched.

use crate::{arrays::check_shape, error::raise, scene::Scene};
use core::ops::ControlFlow;
use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use phase_eval::goals::Answer;
use phase_event::ObservedEvent;
use phase_model::{Body, MAX_ENTITIES, Vec2};
use phase_simple::{Budget, Inference, Observer, Simple};
use pyo3::prelude::*;
use serde_json::json;
use std::sync::{Mutex, PoisonError};

/// Columns of a row of an event: x, y (u), vx, vy (u/s), angle (rad).
const COLUMNS: usize = 5;

/// SIMPLE while an event is watched, row by row. Users see it as `phase_events.Observer`.
#[pyclass(frozen, name = "Observer", module = "phase_events._native")]
pub(crate) struct PythonObserver {
    simple: Simple,
    observer: Mutex<Observer>,
    entities: usize,
}

#[pymethods]
impl PythonObserver {
    /// Begins with the first row, (entities, 5): x, y (u), vx, vy (u/s), angle (rad). Of the scene only walls
    /// and sizes are looked at. [`push`](Self::push) simulates at most `decisions` decisions of minds for a
    /// row; the default is that of [`Budget`]. `PhaseError` for an invalid row.
    #[new]
    fn new(
        py: Python<'_>,
        scene: PyRef<'_, Scene>,
        row: PyReadonlyArray2<'_, f32>,
        seed: u64,
        decisions: Option<usize>,
    ) -> PyResult<Self> {
        let scene = &scene.scene;
        let entities = scene.physics().entities().count();
        let row = read_row(&row, entities)?;
        let observed = ObservedEvent::in_scene(scene, vec![row]).map_err(raise)?;
        let simple = Simple::bundled().map_err(raise)?;
        let mut observer = py.detach(|| simple.observer(&observed, seed)).map_err(raise)?;
        if let Some(decisions) = decisions {
            observer.set_budget(Budget { decisions: Some(decisions) });
        }
        Ok(Self { simple, observer: Mutex::new(observer), entities })
    }

    /// Watches the next row, 0.25 s later, and answers with limited effort, as JSON. `PhaseError` for an
    /// invalid row.
    fn push(&self, py: Python<'_>, row: PyReadonlyArray2<'_, f32>) -> PyResult<String> {
        let row = read_row(&row, self.entities)?;
        let inference = py.detach(|| self.observer.lock().unwrap_or_else(PoisonError::into_inner).push(row));
        self.answer(&inference.map_err(raise)?)
    }

    /// The answer of a batch inference of the rows seen so far, as JSON.
    fn inference(&self, py: Python<'_>) -> PyResult<String> {
        let inference = py.detach(|| {
            let mut observer = self.observer.lock().unwrap_or_else(PoisonError::into_inner);
            observer.inference(&mut || ControlFlow::Continue(()))
        });
        let inference = inference.map_err(raise)?;
        self.answer(&inference.ok_or_else(|| raise("interrupted"))?)
    }
}

impl PythonObserver {
    fn answer(&self, inference: &Inference) -> PyResult<String> {
        let answer = Answer::of(&self.simple.judgement(inference)).map_err(raise)?;
        serde_json::to_string(&json!({ "answer": answer })).map_err(raise)
    }
}

fn read_row(row: &PyReadonlyArray2<'_, f32>, entities: usize) -> PyResult<[Body; MAX_ENTITIES]> {
    check_shape("row", row.shape(), &[entities, COLUMNS])?;
    let mut bodies = [Body::default(); MAX_ENTITIES];
    for (body, row) in bodies.iter_mut().zip(row.as_array().rows()) {
        *body = Body {
            position: Vec2::new(row[0], row[1]),
            velocity: Vec2::new(row[2], row[3]),
            angle: row[4],
            angular_velocity: 0.0,
        };
    }
    Ok(bodies)
}
