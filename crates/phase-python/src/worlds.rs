//! Worlds that are stepped together.

use crate::{
    arrays::{BODY_COLUMNS, Target, reading, row_of, writing},
    error::raise,
    pools::{check_threads, pool},
    saved::WorldState,
    scene::{Scene, action_of},
    world::{World, engine_of, read_history},
};
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use phase_model::{AGENT_COUNT, Action, AgentId, MAX_ENTITIES, PhysicsConfig, State};
use phase_sim::{Distances, Engine, Episode, View, vector::SIZE};
use pyo3::{prelude::*, types::PyBytes};
use rayon::{ThreadPool, prelude::*};
use std::sync::Arc;

/// Worlds that one thread steps at least, so that handing them over pays.
const WORLDS_A_THREAD: usize = 8;

/// Several worlds, each with a scene of its own, that are stepped together.
///
/// A copy, also one that is pickled, has the scenes and the actions so far: it repeats them, which gives the
/// same worlds, bit for bit.
#[pyclass(module = "phase_events._native")]
pub(crate) struct Worlds {
    worlds: Vec<World>,
    engine: Engine,
    view: View,
    threads: usize,
}

/// The parts of the output arrays that a step writes for one world.
struct Row<'a> {
    world: &'a mut World,
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
    fn new(scenes: Vec<Bound<'_, Scene>>, engine: &str, omniscient: bool, threads: usize) -> PyResult<Self> {
        let engine = engine_of(engine)?;
        check_threads(threads)?;
        let worlds = scenes.iter().map(|scene| World::new(scene, engine)).collect();
        let view = if omniscient { View::Everything } else { View::Own };
        Ok(Self { worlds, engine, view, threads })
    }

    /// The arguments of the constructor, and of `__setstate__`.
    #[allow(clippy::type_complexity)]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Vec<Py<Scene>>, &'static str, bool, usize), Vec<Bound<'py, PyBytes>>)>
    {
        let py = slf.py();
        let this = lent(slf)?;
        let scenes = this.worlds.iter().map(|world| world.scene.clone_ref(py)).collect();
        let omniscient = matches!(this.view, View::Everything);
        let actions = this.worlds.iter().map(|world| world.history(py)).collect();
        let arguments = (scenes, this.engine.name(), omniscient, this.threads);
        Ok((slf.get_type().into_any(), arguments, actions))
    }

    /// Repeats the actions of every world: bytes, those of agents 0 and 1 in turns.
    fn __setstate__(&mut self, py: Python<'_>, actions: Vec<Vec<u8>>) -> PyResult<()> {
        let read = |numbers: Vec<u8>| read_history(&numbers);
        let actions: Vec<Vec<_>> = actions.into_iter().map(read).collect::<PyResult<_>>()?;
        let worlds = &mut self.worlds;
        py.detach(|| {
            for (world, actions) in worlds.iter_mut().zip(actions) {
                actions.into_iter().for_each(|actions| world.step(actions));
            }
        });
        Ok(())
    }

    fn __len__(slf: &Bound<'_, Self>) -> PyResult<usize> {
        Ok(lent(slf)?.worlds.len())
    }

    /// Puts a scene into one of the worlds, at its start. `PhaseError` if there is no such world.
    fn reset(slf: &Bound<'_, Self>, world: i64, scene: &Bound<'_, Scene>) -> PyResult<()> {
        let mut this = lent_mut(slf)?;
        let index = this.index(world)?;
        this.worlds[index] = World::new(scene, this.engine);
        Ok(())
    }

    /// A world as it is now. `PhaseError` if there is no such world.
    fn save(slf: &Bound<'_, Self>, world: i64) -> PyResult<WorldState> {
        let this = lent(slf)?;
        let world = this.worlds[this.index(world)?].copied(slf.py());
        Ok(WorldState { world, engine: this.engine })
    }

    /// Puts a saved world in the place of one of these. `PhaseError` if there is no such world, and for a
    /// state of another engine.
    fn restore(slf: &Bound<'_, Self>, world: i64, state: &Bound<'_, WorldState>) -> PyResult<()> {
        let mut this = lent_mut(slf)?;
        let index = this.index(world)?;
        let state = state.get();
        if state.engine != this.engine {
            let (found, own) = (state.engine.name(), this.engine.name());
            return Err(raise(format!("the state is of the engine {found}, the environment of {own}")));
        }
        this.worlds[index] = state.world.copied(slf.py());
        Ok(())
    }

    /// Writes the observations of both agents, (N, 2, OBSERVATION_SIZE), and whether their goals hold, (N,
    /// 2): of these worlds, or of all. `PhaseError` for arrays of other shapes.
    #[pyo3(signature = (observations, achieved, worlds=None))]
    fn observe(
        slf: &Bound<'_, Self>,
        observations: &Bound<'_, PyArray3<f32>>,
        achieved: &Bound<'_, PyArray2<bool>>,
        worlds: Option<Vec<i64>>,
    ) -> PyResult<()> {
        let this = lent(slf)?;
        let this = &*this;
        let count = this.worlds.len();
        let chosen: Vec<usize> = match worlds {
            None => (0..count).collect(),
            Some(worlds) => worlds.into_iter().map(|world| this.index(world)).collect::<PyResult<_>>()?,
        };
        let mut observations = writing("observations", observations, &[count, AGENT_COUNT, SIZE])?;
        let mut achieved = writing("achieved", achieved, &[count, AGENT_COUNT])?;
        let mut observations = Target::new(observations.as_array_mut());
        let observations = observations.numbers();
        let mut achieved = Target::new(achieved.as_array_mut());
        let achieved = achieved.numbers();
        for index in chosen {
            let episode = &this.worlds[index].episode;
            let row = AGENT_COUNT * SIZE;
            write_both(episode, this.view, &mut observations[index * row..(index + 1) * row]);
            achieved[index * AGENT_COUNT..(index + 1) * AGENT_COUNT].copy_from_slice(&episode.achieved());
        }
        Ok(())
    }

    /// Lets both agents of each world act, (N, 2) actions, and writes observations as `observe`, rewards (N,
    /// 2) of Equation 1, and whether the goals hold. `PhaseError` for an invalid action, of which none is
    /// carried out, and for arrays of other shapes.
    fn step(
        slf: &Bound<'_, Self>,
        actions: &Bound<'_, PyArray2<i64>>,
        observations: &Bound<'_, PyArray3<f32>>,
        rewards: &Bound<'_, PyArray2<f64>>,
        achieved: &Bound<'_, PyArray2<bool>>,
    ) -> PyResult<()> {
        let py = slf.py();
        let mut this = lent_mut(slf)?;
        let count = this.worlds.len();
        let actions = reading("actions", actions, &[count, AGENT_COUNT])?;
        let numbers = actions.as_array();
        let rows = numbers.rows().into_iter();
        let actions: Vec<[Action; AGENT_COUNT]> =
            rows.map(|row| Ok([action_of(row[0])?, action_of(row[1])?])).collect::<PyResult<_>>()?;
        let mut observations = writing("observations", observations, &[count, AGENT_COUNT, SIZE])?;
        let mut rewards = writing("rewards", rewards, &[count, AGENT_COUNT])?;
        let mut achieved = writing("achieved", achieved, &[count, AGENT_COUNT])?;
        let mut observations = Target::new(observations.as_array_mut());
        let observations = observations.numbers();
        let mut rewards = Target::new(rewards.as_array_mut());
        let rewards = rewards.numbers();
        let mut achieved = Target::new(achieved.as_array_mut());
        let achieved = achieved.numbers();
        let pool = this.pool(py)?;
        let Self { worlds, view, .. } = &mut *this;
        let view = *view;
        let one = |row: Row<'_>| {
            row.world.step(row.actions);
            let episode = &row.world.episode;
            write_both(episode, view, row.observations);
            row.rewards.copy_from_slice(&episode.rewards(row.actions));
            row.achieved.copy_from_slice(&episode.achieved());
        };
        py.detach(|| {
            let observations = observations.chunks_exact_mut(AGENT_COUNT * SIZE);
            let rows = worlds.iter_mut().zip(actions).zip(observations);
            let rows =
                rows.zip(rewards.chunks_exact_mut(AGENT_COUNT)).zip(achieved.chunks_exact_mut(AGENT_COUNT));
            let rows = rows.map(|((((world, actions), observations), rewards), achieved)| Row {
                world,
                actions,
                observations,
                rewards,
                achieved,
            });
            match pool {
                None => rows.for_each(one),
                Some(pool) => {
                    let rows: Vec<Row<'_>> = rows.collect();
                    pool.install(|| rows.into_par_iter().with_min_len(WORLDS_A_THREAD).for_each(one));
                }
            }
        });
        Ok(())
    }

    /// The bodies of all worlds, now or before the last step: (N, 4, 6), columns x, y (u), angle (rad),
    /// vx, vy (u/s), angular velocity (rad/s); 0 for absent objects.
    #[pyo3(signature = (before=false))]
    fn states<'py>(slf: &Bound<'py, Self>, before: bool) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let this = lent(slf)?;
        let states = PyArray3::zeros(slf.py(), [this.worlds.len(), MAX_ENTITIES, BODY_COLUMNS], false);
        let mut rows = states.readwrite();
        for (world, mut rows) in this.worlds.iter().zip(rows.as_array_mut().outer_iter_mut()) {
            let episode = &world.episode;
            let state = if before { episode.before() } else { episode.state() };
            for (entity, mut row) in episode.physics().entities().zip(rows.outer_iter_mut()) {
                for (to, from) in row.iter_mut().zip(row_of(state.body(entity))) {
                    *to = from;
                }
            }
        }
        drop(rows);
        Ok(states)
    }

    /// The distances to go of all worlds (u), now or before the last step: of each goal, and of each agent to
    /// the object that it moves, two arrays (N, 2).
    #[allow(clippy::type_complexity)]
    #[pyo3(signature = (before=false))]
    fn distances<'py>(
        slf: &Bound<'py, Self>,
        before: bool,
    ) -> PyResult<(Bound<'py, PyArray2<f32>>, Bound<'py, PyArray2<f32>>)> {
        let py = slf.py();
        let mut this = lent_mut(slf)?;
        let pool = this.pool(py)?;
        let worlds = &mut this.worlds;
        let one = |world: &mut World| {
            let state = if before { world.episode.before() } else { world.episode.state() };
            let distances = world.distances.get_or_insert_with(|| Distances::new(&world.scene.get().scene));
            (distances.goals(state), distances.approaches(state))
        };
        let found: Vec<_> = py.detach(|| match pool {
            None => worlds.iter_mut().map(one).collect(),
            Some(pool) => {
                pool.install(|| worlds.par_iter_mut().with_min_len(WORLDS_A_THREAD).map(one).collect())
            }
        });
        let array = |numbers: Vec<f32>| PyArray1::from_vec(py, numbers).reshape([found.len(), AGENT_COUNT]);
        let goals = array(found.iter().flat_map(|(goals, _)| *goals).collect())?;
        Ok((goals, array(found.iter().flat_map(|(_, approaches)| *approaches).collect())?))
    }

    /// The attitude of each agent towards the other, (N, 2): 1 helps, −1 hinders, 0 neither.
    fn attitudes<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let this = lent(slf)?;
        let alphas = |world: &World| {
            let attitudes = world.scene.get().scene.attitudes();
            attitudes.map(|attitude| i64::from(attitude.alpha()))
        };
        let alphas: Vec<i64> = this.worlds.iter().flat_map(alphas).collect();
        PyArray1::from_vec(slf.py(), alphas).reshape([this.worlds.len(), AGENT_COUNT])
    }
}

impl Worlds {
    /// The threads that step these worlds, if that pays.
    pub(crate) fn pool(&self, py: Python<'_>) -> PyResult<Option<Arc<ThreadPool>>> {
        let pays = self.threads > 1 && self.worlds.len() > WORLDS_A_THREAD;
        pays.then(|| pool(py, self.threads)).transpose()
    }

    /// The episodes of all worlds.
    pub(crate) fn episodes(&self) -> Vec<&Episode> {
        self.worlds.iter().map(|world| &world.episode).collect()
    }

    /// The number of a world.
    pub(crate) fn index(&self, world: i64) -> PyResult<usize> {
        let count = self.worlds.len();
        let index = usize::try_from(world).ok().filter(|&index| index < count);
        index.ok_or_else(|| raise(format!("there are {count} worlds, and no world {world}")))
    }

    fn episode(&self, world: i64) -> PyResult<&Episode> {
        Ok(&self.worlds[self.index(world)?].episode)
    }

    /// The physics and the state of a world.
    pub(crate) fn view(&self, world: i64) -> PyResult<(&PhysicsConfig, &State)> {
        self.episode(world).map(|episode| (episode.physics(), episode.state()))
    }
}

/// Worlds to look at.
///
/// # Errors
/// `PhaseError` while another thread steps them.
pub(crate) fn lent<'py>(worlds: &Bound<'py, Worlds>) -> PyResult<PyRef<'py, Worlds>> {
    worlds.try_borrow().map_err(|_| raise(IN_USE))
}

fn lent_mut<'py>(worlds: &Bound<'py, Worlds>) -> PyResult<PyRefMut<'py, Worlds>> {
    worlds.try_borrow_mut().map_err(|_| raise(IN_USE))
}

const IN_USE: &str = "the worlds are being stepped by another thread";

/// Writes the observations of both agents of a world.
fn write_both(episode: &Episode, view: View, out: &mut [f32]) {
    for (agent, out) in AgentId::ALL.into_iter().zip(out.chunks_exact_mut(SIZE)) {
        episode.write_observation(agent, view, out);
    }
}
