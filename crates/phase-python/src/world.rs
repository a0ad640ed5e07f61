//! One world, and how it came about.

use crate::{
    error::raise,
    scene::{Scene, action_of},
};
use phase_model::{AGENT_COUNT, Action};
use phase_sim::{Distances, Engine, Episode};
use pyo3::{prelude::*, types::PyBytes};

/// A world and how it came about.
pub(crate) struct World {
    pub(crate) scene: Py<Scene>,
    pub(crate) episode: Episode,
    pub(crate) actions: Vec<[Action; AGENT_COUNT]>,
    /// Made when they are first asked for.
    pub(crate) distances: Option<Distances>,
}

impl World {
    pub(crate) fn new(scene: &Bound<'_, Scene>, engine: Engine) -> Self {
        let episode = Episode::new(&scene.get().scene, engine);
        Self { scene: scene.clone().unbind(), episode, actions: Vec::new(), distances: None }
    }

    pub(crate) fn copied(&self, py: Python<'_>) -> Self {
        Self {
            scene: self.scene.clone_ref(py),
            episode: self.episode.clone(),
            actions: self.actions.clone(),
            distances: None,
        }
    }

    /// The actions as bytes, those of agents 0 and 1 in turns.
    pub(crate) fn history<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        let numbers: Vec<u8> = self.actions.iter().flatten().map(|action| action.index() as u8).collect();
        PyBytes::new(py, &numbers)
    }

    pub(crate) fn step(&mut self, actions: [Action; AGENT_COUNT]) {
        self.episode.step(actions);
        self.actions.push(actions);
    }
}

/// Actions from bytes, as of [`World::history`].
///
/// # Errors
/// `PhaseError` for a number that is no action.
pub(crate) fn read_history(numbers: &[u8]) -> PyResult<Vec<[Action; AGENT_COUNT]>> {
    let pairs = numbers.chunks_exact(AGENT_COUNT);
    pairs.map(|pair| Ok([action_of(pair[0].into())?, action_of(pair[1].into())?])).collect()
}

/// An engine by its name.
///
/// # Errors
/// `PhaseError` that has the names there are.
pub(crate) fn engine_of(name: &str) -> PyResult<Engine> {
    Engine::named(name).ok_or_else(|| {
        let names = Engine::ALL.map(Engine::name).join(" or ");
        raise(format!("engine must be {names}, not {name:?}"))
    })
}
