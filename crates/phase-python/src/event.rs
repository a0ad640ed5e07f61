//! Events: simulated, read, as arrays.

use crate::{
    arrays::row_of,
    error::raise,
    mind::read_parameters,
    scene::{Scene, number_of},
    world::engine_of,
};
use core::ops::ControlFlow;
use numpy::{PyArray1, PyArray2, PyArray3};
use phase_event::{Recording, Thought, from_json, to_json};
use phase_files::atomic;
use phase_model::arena::SUBSTEPS;
use phase_runs::{engine::GENERATOR, event_writer::settings_value, listener::Silent, source::EventInput};
use phase_sim::{SimulationSettings, simulate_with};
use pyo3::prelude::*;
use std::{path::PathBuf, sync::Arc};

/// An event: a scene and the motion in it, simulated or recorded. Users see it as `phase_events.Event`.
#[pyclass(frozen, module = "phase_events._native")]
pub(crate) struct Event {
    pub(crate) recording: Arc<Recording>,
}

#[pymethods]
impl Event {
    /// The event of a document in the format phase-events/1 that has one. `PhaseError` names the field and
    /// the rule if it has none, or several.
    #[new]
    fn from_json(py: Python<'_>, text: &str) -> PyResult<Self> {
        let read = Self::list_from_json(py, text)?;
        let [event]: [Self; 1] = read
            .try_into()
            .map_err(|read: Vec<Self>| raise(format!("one event is expected, not {}", read.len())))?;
        Ok(event)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        Ok((slf.get_type().into_any(), (slf.get().to_json()?,)))
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    /// The events of a document in the format phase-events/1. `PhaseError` names the field and the rule if it
    /// is none.
    #[staticmethod]
    fn list_from_json(py: Python<'_>, text: &str) -> PyResult<Vec<Self>> {
        let read = py.detach(|| from_json(text)).map_err(raise)?;
        Ok(read.into_iter().map(|recording| Self { recording: Arc::new(recording) }).collect())
    }

    /// The event in the format phase-events/1.
    fn to_json(&self) -> PyResult<String> {
        to_json(std::slice::from_ref(&*self.recording)).map_err(raise)
    }

    /// The name of the event, which no other event of its file has.
    #[getter]
    fn id(&self) -> &str {
        &self.recording.id
    }

    /// The kind of event that its scene was made for.
    #[getter]
    fn kind(&self) -> &'static str {
        self.recording.scene.kind.name()
    }

    /// The relation of both agents.
    #[getter]
    fn relation(&self) -> &'static str {
        self.recording.relation.name()
    }

    /// The number of steps of 0.25 s.
    #[getter]
    fn steps(&self) -> usize {
        self.recording.trajectory.steps()
    }

    /// The scene that it happened in.
    #[getter]
    fn scene(&self) -> Scene {
        Scene { scene: self.recording.scene.clone() }
    }

    /// Both agents' goals: their indices among the goals that methods tell apart.
    #[getter]
    fn goal_indices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let index = |goal| number_of(goal).map(|index| index as i64);
        let indices = self.recording.scene.goals().map(index);
        let indices: Option<Vec<i64>> = indices.into_iter().collect();
        Ok(PyArray1::from_vec(py, indices.ok_or_else(|| raise("an agent cannot touch itself"))?))
    }

    /// Both agents' attitudes: 1 helps, -1 hinders, 0 neither.
    #[getter]
    fn attitudes<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let attitudes = self.recording.scene.attitudes().map(|attitude| attitude.alpha().into());
        PyArray1::from_slice(py, &attitudes)
    }

    /// The level of strength of both agents, 0 to 3.
    #[getter]
    fn strength_levels<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let levels = self.recording.scene.agents.map(|agent| agent.strength.level().into());
        PyArray1::from_slice(py, &levels)
    }

    /// The bodies after every substep: (5 · steps, entities, 6), columns x, y (u), angle (rad), vx, vy (u/s),
    /// angular velocity (rad/s); `None` for a recording, which has none.
    fn substeps<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray3<f32>>>> {
        let Some(simulation) = &self.recording.simulation else { return Ok(None) };
        let entities = self.recording.scene.physics().entities();
        let entities: Vec<_> = entities.collect();
        let states = simulation.event.steps.iter().flat_map(|step| &step.substeps);
        let rows: Vec<Vec<Vec<f32>>> = states
            .map(|state| entities.iter().map(|&entity| row_of(state.body(entity)).to_vec()).collect())
            .collect();
        debug_assert_eq!(rows.len(), SUBSTEPS * simulation.event.steps.len());
        PyArray3::from_vec3(py, &rows).map(Some).map_err(raise)
    }

    /// Both agents' actions: (steps, 2); for a recording those that were recovered from its motion, if any.
    fn actions<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<i64>>>> {
        let simulated = self.recording.simulation.as_ref();
        let simulated =
            simulated.map(|simulation| simulation.event.steps.iter().map(|step| step.actions).collect());
        let recovered = self.recording.recovered_actions.as_ref().map(|recovered| recovered.steps.clone());
        let Some(steps): Option<Vec<_>> = simulated.or(recovered) else { return Ok(None) };
        let rows: Vec<Vec<i64>> =
            steps.iter().map(|actions| actions.map(|action| action.index() as i64).to_vec()).collect();
        PyArray2::from_vec2(py, &rows).map(Some).map_err(raise)
    }

    /// The reasons of both agents' decisions at every step, as JSON; `None` for a recording.
    fn thoughts(&self) -> PyResult<Option<String>> {
        let Some(simulation) = &self.recording.simulation else { return Ok(None) };
        let thoughts: Vec<_> = simulation
            .event
            .steps
            .iter()
            .map(|step| step.thoughts.each_ref().map(Thought::described))
            .collect();
        serde_json::to_string(&thoughts).map(Some).map_err(raise)
    }
}

/// The events of a file or folder, read one by one.
#[pyclass(frozen, module = "phase_events._native")]
pub(crate) struct EventSource {
    /// The absolute path of the events.
    path: PathBuf,
    source: EventInput,
}

#[pymethods]
impl EventSource {
    /// Opens a file or a folder, without reading its events. `PhaseError` if there are none.
    #[new]
    fn open(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let source = py.detach(|| EventInput::open(&path, &[], &Silent)).map_err(raise)?;
        let path = std::path::absolute(path).map_err(raise)?;
        Ok(Self { path, source })
    }

    /// A copy, also one that is pickled, opens the file or folder again.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (PathBuf,)) {
        (slf.get_type().into_any(), (slf.get().path.clone(),))
    }

    fn __len__(&self) -> usize {
        self.source.len()
    }

    /// Reads the event at an index, from 0 to the number of events less one. `PhaseError` names file, field
    /// and rule if it is invalid.
    fn load(&self, py: Python<'_>, index: usize) -> PyResult<Event> {
        if index >= self.source.len() {
            return Err(raise(format!("there are {} events, and no event {index}", self.source.len())));
        }
        let recording = py.detach(|| self.source.load(index)).map_err(raise)?;
        Ok(Event { recording: Arc::new(recording.into_owned()) })
    }
}

/// Simulates a scene with two of PHASE's minds, for at most `max_steps` steps of 0.25 s. `parameters` is a
/// JSON object of those that differ from the defaults. `PhaseError` for an invalid argument.
#[pyfunction]
#[pyo3(signature = (scene, seed, id, engine, max_steps, parameters))]
pub(crate) fn simulate(
    py: Python<'_>,
    scene: PyRef<'_, Scene>,
    seed: u64,
    id: &str,
    engine: &str,
    max_steps: usize,
    parameters: Option<&str>,
) -> PyResult<Event> {
    let engine = engine_of(engine)?;
    let minds = read_parameters(parameters)?;
    let settings = SimulationSettings { engine, max_steps, minds, ..SimulationSettings::default() };
    let scene = scene.scene.clone();
    let mut interrupted = None;
    let found = py.detach(|| {
        simulate_with(&scene, seed, &settings, &mut |_| match Python::attach(|py| py.check_signals()) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                interrupted = Some(error);
                ControlFlow::Break(())
            }
        })
    });
    if let Some(error) = interrupted {
        return Err(error);
    }
    let (event, _) = found.map_err(raise)?;
    let settings = settings_value(&settings).map_err(raise)?;
    let recording = Recording::of_event(id, event, GENERATOR.into(), settings);
    // An event is the same wherever it comes from: it is written and read. That checks its id, too.
    let text = to_json(&[recording]).map_err(raise)?;
    Event::from_json(py, &text)
}

/// Writes a text file, whole or not at all. `PhaseError` if it cannot be written; an older one of that name
/// is unchanged then.
#[pyfunction]
pub(crate) fn write_text(path: PathBuf, text: &str) -> PyResult<()> {
    atomic::write(&path, text.as_bytes()).map_err(raise)
}
