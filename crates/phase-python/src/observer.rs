//! SIMPLE while an event is watched.

use crate::{arrays::check_shape, error::raise, scene::Scene};
use core::ops::ControlFlow;
use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use phase_eval::goals::Answer;
use phase_event::ObservedEvent;
use phase_model::{Body, MAX_ENTITIES, Vec2};
use phase_simple::{
    Budget, Guidance, Guide, Inference, InferenceSettings, IntentNetwork, Observer as Simple, ReportModel,
};
use pyo3::prelude::*;
use serde_json::json;
use std::sync::{Mutex, OnceLock, PoisonError};

/// Columns of a row of an event: x, y (u), vx, vy (u/s), angle (rad).
const COLUMNS: usize = 5;

/// Watches an event row by row.
#[pyclass(frozen, module = "phase_events._native")]
pub(crate) struct Observer {
    simple: Mutex<Simple<'static>>,
    entities: usize,
}

#[pymethods]
impl Observer {
    /// Begins with the first row, (entities, 5). Of the scene only walls and sizes are looked at.
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
        let sizes = scene.objects.iter().map(|object| object.size).collect();
        let agents = scene.agents.map(|agent| agent.size);
        let observed = ObservedEvent::new(scene.layout, agents, sizes, vec![row]).map_err(raise)?;
        let network = network()?;
        let simple = py.detach(|| {
            let guide = Guide { network, guidance: Guidance::default() };
            Simple::new(&observed, Some(&guide), seed, &InferenceSettings::averaged())
        });
        let mut simple = simple.map_err(raise)?;
        if let Some(decisions) = decisions {
            simple.set_budget(Budget { decisions: Some(decisions) });
        }
        Ok(Self { simple: Mutex::new(simple), entities })
    }

    /// Watches the next row and answers with limited effort, as JSON.
    fn push(&self, py: Python<'_>, row: PyReadonlyArray2<'_, f32>) -> PyResult<String> {
        let row = read_row(&row, self.entities)?;
        let inference = py.detach(|| self.simple.lock().unwrap_or_else(PoisonError::into_inner).push(row));
        answer(&inference.map_err(raise)?)
    }

    /// The answer of a batch inference of the rows seen so far, as JSON.
    fn inference(&self, py: Python<'_>) -> PyResult<String> {
        let inference = py.detach(|| {
            let mut simple = self.simple.lock().unwrap_or_else(PoisonError::into_inner);
            simple.inference(&mut || ControlFlow::Continue(()))
        });
        let inference = inference.map_err(raise)?;
        answer(&inference.ok_or_else(|| raise("interrupted"))?)
    }
}

fn answer(inference: &Inference) -> PyResult<String> {
    let model = ReportModel::bundled().map_err(raise)?;
    let answer = Answer::of(&inference.judgement(&model)).map_err(raise)?;
    serde_json::to_string(&json!({ "answer": answer })).map_err(raise)
}

/// The bundled intent network, which observers share.
fn network() -> PyResult<&'static IntentNetwork> {
    static NETWORK: OnceLock<IntentNetwork> = OnceLock::new();
    if let Some(network) = NETWORK.get() {
        return Ok(network);
    }
    let network = IntentNetwork::bundled().map_err(raise)?;
    Ok(NETWORK.get_or_init(|| network))
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
