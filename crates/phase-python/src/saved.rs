//! Worlds that are saved, to go back to.

use crate::{
    scene::Scene,
    world::{World, engine_of, read_history},
};
use phase_sim::Engine;
use pyo3::{prelude::*, types::PyBytes};

/// A world as it was at one moment, with the engine's memory. It does not change.
///
/// In this process it is a copy of the world. Pickled, it is the scene and the actions so far, and is
/// simulated again, which gives the same world, bit for bit.
#[pyclass(frozen, module = "phase_events._native")]
pub(crate) struct WorldState {
    pub(crate) world: World,
    pub(crate) engine: Engine,
}

#[pymethods]
impl WorldState {
    /// The world that an engine makes of a scene and actions: bytes, those of agents 0 and 1 in turns.
    /// `PhaseError` for an unknown engine, and for a number that is no action.
    #[new]
    fn new(py: Python<'_>, scene: &Bound<'_, Scene>, engine: &str, actions: Vec<u8>) -> PyResult<Self> {
        let engine = engine_of(engine)?;
        let mut world = World::new(scene, engine);
        let actions = read_history(&actions)?;
        py.detach(|| actions.into_iter().for_each(|actions| world.step(actions)));
        Ok(Self { world, engine })
    }

    #[allow(clippy::type_complexity)]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> (Bound<'py, PyAny>, (Py<Scene>, &'static str, Bound<'py, PyBytes>)) {
        let py = slf.py();
        let Self { world, engine } = slf.get();
        let arguments = (world.scene.clone_ref(py), engine.name(), world.history(py));
        (slf.get_type().into_any(), arguments)
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    /// The scene.
    #[getter]
    fn scene(&self, py: Python<'_>) -> Py<Scene> {
        self.world.scene.clone_ref(py)
    }

    /// The name of the engine.
    #[getter]
    const fn engine(&self) -> &'static str {
        self.engine.name()
    }

    /// The number of steps since the start of the scene.
    fn __len__(&self) -> usize {
        self.world.actions.len()
    }
}
