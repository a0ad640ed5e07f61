//! Worlds that are stepped together.

use crate::{
    arrays::{BODY_COLUMNS, check_shape, row_of},
    error::raise,
    scene::{Scene, action_of},
};
use numpy::{
    PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyReadwriteArray2,
    PyReadwriteArray3, PyUntypedArrayMethods,
};
use phase_model::{AGENT_COUNT, Action, AgentId, MAX_ENTITIES, PhysicsConfig, State};
use phase_sim::{Engine, Episode, View, vector::SIZE};
use pyo3::prelude::*;
use rayon::prelude::*;

/// Several worlds, each with a scene of its own, that are stepped together.
#[pyclass(module = "phase_events._native")]
pub(crate) struct Worlds {
    episodes: Vec<Episode>,
    engine: Engine,
    view: View,
    pool: Option<rayon::ThreadPool>,
}

/// The parts of the output arrays that a step writes for one world.
struct Row<'a> {
    episode: &'a mut Episode,
    actions: [Action; AGENT_COUNT],
    observations: &'a mut [f32],
    rewards: &'a mut [f64],
    achieved: &'a mut [bool],
}

#[pymethods]
impl Worlds {
    /// Worlds at the start of their scenes. Agents observe everything if `omniscient`. At most `threads`
    /// worlds are stepped at the same time. `PhaseError` for an unknown engine.
    #[new]
    #[pyo3(signature = (scenes, engine, omniscient, threads))]
    fn new(
        py: Python<'_>,
        scenes: Vec<PyRef<'_, Scene>>,
        engine: &str,
        omniscient: bool,
        threads: usize,
    ) -> PyResult<Self> {
        let engine = engine_of(engine)?;
        let pool = match threads {
            0 | 1 => None,
            threads => Some(
                py.detach(|| rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(raise))?,
            ),
        };
        let episodes = scenes.iter().map(|scene| Episode::new(&scene.scene, engine)).collect();
        let view = if omniscient { View::Everything } else { View::Own };
        Ok(Self { episodes, engine, view, pool })
    }

    fn __len__(&self) -> usize {
        self.episodes.len()
    }

    /// Puts a scene into one of the worlds, at its start. `PhaseError` if there is no such world.
    fn reset(&mut self, world: i64, scene: PyRef<'_, Scene>) -> PyResult<()> {
        let index = self.index(world)?;
        self.episodes[index] = Episode::new(&scene.scene, self.engine);
        Ok(())
    }

    /// Writes the observations of both agents, (N, 2, OBSERVATION_SIZE), and whether their goals hold, (N,
    /// 2): of these worlds, or of all. `PhaseError` for arrays of other shapes.
    #[pyo3(signature = (observations, achieved, worlds=None))]
    fn observe(
        &self,
        py: Python<'_>,
        mut observations: PyReadwriteArray3<'_, f32>,
        mut achieved: PyReadwriteArray2<'_, bool>,
        worlds: Option<PyReadonlyArray1<'_, i64>>,
    ) -> PyResult<()> {
        let chosen: Vec<usize> = match worlds {
            None => (0..self.episodes.len()).collect(),
            Some(worlds) => {
                worlds.as_array().iter().map(|&world| self.index(world)).collect::<PyResult<_>>()?
            }
        };
        self.check_shapes(&observations, &achieved)?;
        let observations = observations.as_slice_mut()?;
        let achieved = achieved.as_slice_mut()?;
        py.detach(|| {
            for index in chosen {
                let episode = &self.episodes[index];
                let row = AGENT_COUNT * SIZE;
                write_both(episode, self.view, &mut observations[index * row..(index + 1) * row]);
                achieved[index * AGENT_COUNT..(index + 1) * AGENT_COUNT].copy_from_slice(&episode.achieved());
            }
        });
        Ok(())
    }

    /// Lets both agents of each world act, (N, 2) actions, and writes observations as `observe`, rewards (N,
    /// 2) of Equation 1, and whether the goals hold. `PhaseError` for an invalid action, of which none is
    /// carried out, and for arrays of other shapes.
    fn step(
        &mut self,
        py: Python<'_>,
        actions: PyReadonlyArray2<'_, i64>,
        mut observations: PyReadwriteArray3<'_, f32>,
        mut rewards: PyReadwriteArray2<'_, f64>,
        mut achieved: PyReadwriteArray2<'_, bool>,
    ) -> PyResult<()> {
        let count = self.episodes.len();
        check_shape("actions", actions.shape(), &[count, AGENT_COUNT])?;
        check_shape("rewards", rewards.shape(), &[count, AGENT_COUNT])?;
        self.check_shapes(&observations, &achieved)?;
        let numbers = actions.as_array();
        let rows = numbers.rows().into_iter();
        let actions: Vec<[Action; AGENT_COUNT]> =
            rows.map(|row| Ok([action_of(row[0])?, action_of(row[1])?])).collect::<PyResult<_>>()?;
        let observations = observations.as_slice_mut()?;
        let rewards = rewards.as_slice_mut()?;
        let achieved = achieved.as_slice_mut()?;
        let Self { episodes, view, pool, .. } = self;
        let view = *view;
        let one = |row: Row<'_>| {
            row.episode.step(row.actions);
            write_both(row.episode, view, row.observations);
            row.rewards.copy_from_slice(&row.episode.rewards(row.actions));
            row.achieved.copy_from_slice(&row.episode.achieved());
        };
        py.detach(|| {
            let observations = observations.chunks_exact_mut(AGENT_COUNT * SIZE);
            let rows = episodes.iter_mut().zip(actions).zip(observations);
            let rows =
                rows.zip(rewards.chunks_exact_mut(AGENT_COUNT)).zip(achieved.chunks_exact_mut(AGENT_COUNT));
            let rows = rows.map(|((((episode, actions), observations), rewards), achieved)| Row {
                episode,
                actions,
                observations,
                rewards,
                achieved,
            });
            match pool {
                None => rows.for_each(one),
                Some(pool) => {
                    let rows: Vec<Row<'_>> = rows.collect();
                    pool.install(|| rows.into_par_iter().with_min_len(8).for_each(one));
                }
            }
        });
        Ok(())
    }

    /// The bodies of a world: (entities, 6), columns x, y (u), angle (rad), vx, vy (u/s), angular velocity
    /// (rad/s).
    fn bodies<'py>(&self, py: Python<'py>, world: i64) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let episode = self.episode(world)?;
        let rows: Vec<Vec<f32>> = episode
            .physics()
            .entities()
            .map(|entity| row_of(episode.state().body(entity)).to_vec())
            .collect();
        PyArray2::from_vec2(py, &rows).map_err(raise)
    }

    /// The bodies of all worlds: (N, 4, 6), columns as of `bodies`; 0 for absent objects.
    fn states<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray3<f32>> {
        let states = PyArray3::zeros(py, [self.episodes.len(), MAX_ENTITIES, BODY_COLUMNS], false);
        let mut rows = states.readwrite();
        for (episode, mut rows) in self.episodes.iter().zip(rows.as_array_mut().outer_iter_mut()) {
            for (entity, mut row) in episode.physics().entities().zip(rows.outer_iter_mut()) {
                for (to, from) in row.iter_mut().zip(row_of(episode.state().body(entity))) {
                    *to = from;
                }
            }
        }
        drop(rows);
        states
    }

    /// The bodies after each substep of the last step: (5, entities, 6).
    fn substeps<'py>(&self, py: Python<'py>, world: i64) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let episode = self.episode(world)?;
        let rows = |state: &State| {
            episode.physics().entities().map(|entity| row_of(state.body(entity)).to_vec()).collect()
        };
        let states: Vec<Vec<Vec<f32>>> = episode.substeps().iter().map(rows).collect();
        PyArray3::from_vec3(py, &states).map_err(raise)
    }

    /// The object that each agent of a world holds: its number, or −1.
    fn held<'py>(&self, py: Python<'py>, world: i64) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let state = self.episode(world)?.state();
        let held =
            AgentId::ALL.map(|agent| state.held_object(agent).map_or(-1, |object| object.number().into()));
        Ok(PyArray1::from_slice(py, &held))
    }
}

impl Worlds {
    /// The number of a world.
    fn index(&self, world: i64) -> PyResult<usize> {
        let count = self.episodes.len();
        let index = usize::try_from(world).ok().filter(|&index| index < count);
        index.ok_or_else(|| raise(format!("there are {count} worlds, and no world {world}")))
    }

    fn episode(&self, world: i64) -> PyResult<&Episode> {
        Ok(&self.episodes[self.index(world)?])
    }

    fn check_shapes(
        &self,
        observations: &PyReadwriteArray3<'_, f32>,
        achieved: &PyReadwriteArray2<'_, bool>,
    ) -> PyResult<()> {
        let count = self.episodes.len();
        check_shape("observations", observations.shape(), &[count, AGENT_COUNT, SIZE])?;
        check_shape("achieved", achieved.shape(), &[count, AGENT_COUNT])
    }

    /// The physics and the state of a world.
    pub(crate) fn view(&self, world: i64) -> PyResult<(&PhysicsConfig, &State)> {
        self.episode(world).map(|episode| (episode.physics(), episode.state()))
    }
}

/// Writes the observations of both agents of a world.
fn write_both(episode: &Episode, view: View, out: &mut [f32]) {
    for (agent, out) in AgentId::ALL.into_iter().zip(out.chunks_exact_mut(SIZE)) {
        episode.write_observation(agent, view, out);
    }
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
