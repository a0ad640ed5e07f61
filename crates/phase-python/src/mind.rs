//! A mind that decides from observations.

use crate::{
    arrays::{BODY_COLUMNS, numbers, reading, row_of, rows},
    error::raise,
    pools::pool,
    scene::{Scene, action_of, agent_of},
};
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use phase_minds::{Agent, MindKind, MindParameters};
use phase_model::{
    Action, AgentId,
    json::parse_as,
    random::{self, Pcg64Mcg, Purpose},
};
use phase_perception::Observation;
use phase_sim::vector::{self, SIZE, VectorWriter};
use pyo3::{PyTypeInfo, prelude::*};
use rand::Rng;
use rayon::prelude::*;
use serde_json::Value;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The mind of one agent, with its belief, of the kind `phase`. Users see it as `phase_events.Mind`.
///
/// A copy believes and decides as the original, bit for bit. One that is pickled has what was observed and
/// done, and perceives that again, without the searches.
#[pyclass(frozen, module = "phase_events._native")]
pub(crate) struct Mind {
    agent: AgentId,
    entities: usize,
    scene: Py<Scene>,
    seed: u64,
    parameters: Option<String>,
    state: Arc<Mutex<MindState>>,
}

/// The past of a mind: its observations as vectors, (N, OBSERVATION_SIZE), the actions between
/// them, the last action, the number of searches, and the reasons of the last decision as JSON.
type Past<'py> = (Bound<'py, PyArray2<f32>>, Vec<usize>, Option<usize>, u64, Option<String>);

/// The parts of a mind that change as it observes and decides.
#[derive(Clone)]
struct MindState {
    scene: phase_model::Scene,
    parameters: MindParameters,
    /// The agent, from its first observation on.
    agent: Option<Agent>,
    belief_random: Pcg64Mcg,
    search_random: Pcg64Mcg,
    /// Every observation, and the action before it, which the first has not.
    observed: Vec<(Option<Action>, Observation)>,
    last_action: Option<Action>,
    /// Decisions for which the generator of searches was asked: each draws one number, from which the search
    /// has a generator of its own, or none.
    searches: u64,
    /// The reasons of the last decision.
    thought: Option<Value>,
}

impl MindState {
    /// Observes what the action has led to, or at first what there is.
    fn perceive(&mut self, action: Option<Action>, observation: &Observation) -> Result<Agent, String> {
        let agent = match self.agent.take().zip(action) {
            Some((mut agent, action)) => {
                agent.perceive(action, observation, &[], &mut self.belief_random);
                self.observed.push((Some(action), *observation));
                agent
            }
            None => {
                self.observed = vec![(None, *observation)];
                Agent::new(&self.scene, &self.parameters, observation, None, &mut self.belief_random)
                    .map_err(|error| error.to_string())?
            }
        };
        Ok(agent)
    }

    fn decide(&mut self, observation: &Observation, action: Option<Action>) -> Result<Action, String> {
        let agent = self.perceive(action.or(self.last_action), observation)?;
        let agent = self.agent.insert(agent);
        let before = self.search_random.clone();
        let decided = agent.decide(&mut self.search_random);
        self.searches += u64::from(self.search_random != before);
        let (action, thought) = decided.map_err(|error| error.to_string())?;
        self.last_action = Some(action);
        self.thought = Some(thought.described());
        Ok(action)
    }
}

#[pymethods]
impl Mind {
    /// The mind of agent 0 or 1 in a scene. `parameters` is a JSON object of those that differ from the
    /// defaults. `PhaseError` for an invalid argument, and for parameters of another kind of mind.
    #[new]
    #[pyo3(signature = (scene, agent, seed, parameters))]
    fn new(scene: &Bound<'_, Scene>, agent: usize, seed: u64, parameters: Option<String>) -> PyResult<Self> {
        let agent = agent_of(agent)?;
        let given = parameters;
        let parameters = own_parameters(given.as_deref())?;
        let entities = scene.get().scene.physics().entities().count();
        let state = MindState {
            scene: scene.get().scene.clone(),
            parameters,
            agent: None,
            belief_random: random::stream(seed, Purpose::Belief, agent.number().into()),
            search_random: random::stream(seed, Purpose::Search, agent.number().into()),
            observed: Vec::new(),
            last_action: None,
            searches: 0,
            thought: None,
        };
        let state = Arc::new(Mutex::new(state));
        Ok(Self { agent, entities, scene: scene.clone().unbind(), seed, parameters: given, state })
    }

    /// Checks parameters, without a scene. `PhaseError` as of the constructor.
    #[staticmethod]
    fn check(parameters: &str) -> PyResult<()> {
        own_parameters(Some(parameters)).map(drop)
    }

    /// The arguments of the constructor, and of `__setstate__`.
    #[allow(clippy::type_complexity)]
    fn __reduce__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyAny>, (Py<Scene>, u8, u64, Option<String>), Past<'py>)> {
        let arguments = (self.scene.clone_ref(py), self.agent.number(), self.seed, self.parameters.clone());
        let state = self.state();
        let mut vectors = vec![0.0; state.observed.len() * SIZE];
        let writer = VectorWriter::new(&state.scene);
        for ((_, observation), vector) in state.observed.iter().zip(vectors.chunks_exact_mut(SIZE)) {
            writer.write(observation, vector);
        }
        let vectors = PyArray1::from_vec(py, vectors).reshape([state.observed.len(), SIZE])?;
        let actions = state.observed.iter().filter_map(|(action, _)| action.map(Action::index)).collect();
        let thought = state.thought.as_ref().map(Value::to_string);
        let past = (vectors, actions, state.last_action.map(Action::index), state.searches, thought);
        Ok((Self::type_object(py).into_any(), arguments, past))
    }

    fn __copy__(&self, py: Python<'_>) -> Self {
        self.copied(py)
    }

    fn __deepcopy__(&self, py: Python<'_>, _memo: &Bound<'_, PyAny>) -> Self {
        self.copied(py)
    }

    /// Perceives again what a mind has gone through, and goes through its decisions without their searches.
    /// `PhaseError` for what no mind of this agent has.
    fn __setstate__(&self, py: Python<'_>, past: Past<'_>) -> PyResult<()> {
        let (vectors, actions, last_action, searches, thought) = past;
        let action = |number: usize| action_of(i64::try_from(number).unwrap_or(-1));
        let actions: Vec<Action> = actions.into_iter().map(action).collect::<PyResult<_>>()?;
        let vectors = vectors.try_readonly().map_err(raise)?;
        let observed = rows(&vectors)
            .chunks_exact(SIZE)
            .map(|row| vector::read(self.agent, row).map_err(raise))
            .collect::<PyResult<Vec<_>>>()?;
        let mut state = self.state();
        let state = &mut *state;
        state.last_action = last_action.map(action).transpose()?;
        state.thought = thought.map(|text| parse_as(&text)).transpose().map_err(raise)?;
        state.searches = searches;
        py.detach(|| {
            let before = core::iter::once(None).chain(actions.into_iter().map(Some));
            for (action, observation) in before.zip(&observed) {
                let agent = state.perceive(action, observation)?;
                state.agent.insert(agent).relive();
            }
            (0..searches).for_each(|_| {
                state.search_random.next_u64();
            });
            Ok(())
        })
        .map_err(|error: String| raise(error))
    }

    /// Observes and decides; the number of the action. `observation` is (OBSERVATION_SIZE,); `action` is the
    /// one that the agent took since its last decision, if it is another than was decided. `PhaseError` for
    /// an invalid action, and for numbers that are no observation of this agent.
    #[pyo3(signature = (observation, action))]
    fn decide(
        &self,
        py: Python<'_>,
        observation: &Bound<'_, PyArray1<f32>>,
        action: Option<i64>,
    ) -> PyResult<usize> {
        let action = action.map(action_of).transpose()?;
        let observation = reading("observation", observation, &[SIZE])?;
        let observation = vector::read(self.agent, &numbers(&observation)).map_err(raise)?;
        let decided = py.detach(|| {
            self.state.lock().unwrap_or_else(PoisonError::into_inner).decide(&observation, action)
        });
        decided.map(Action::index).map_err(raise)
    }

    /// The possible worlds, equally likely: (particles, entities, 6), columns x, y (u), angle (rad), vx, vy
    /// (u/s), angular velocity (rad/s); `None` before the first decision.
    fn particles<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray3<f32>>>> {
        let state = self.state();
        let Some(agent) = &state.agent else { return Ok(None) };
        let particles: Vec<Vec<Vec<f32>>> = agent
            .belief()
            .particles()
            .iter()
            .map(|particle| {
                particle.bodies[..self.entities].iter().map(|body| row_of(body).to_vec()).collect()
            })
            .collect();
        debug_assert!(particles.iter().flatten().all(|row| row.len() == BODY_COLUMNS));
        PyArray3::from_vec3(py, &particles).map(Some).map_err(raise)
    }

    /// The reasons of the last decision as JSON; `None` before the first one.
    fn thought(&self) -> PyResult<Option<String>> {
        let state = self.state();
        Ok(state.thought.as_ref().map(Value::to_string))
    }
}

impl Mind {
    fn copied(&self, py: Python<'_>) -> Self {
        Self {
            scene: self.scene.clone_ref(py),
            parameters: self.parameters.clone(),
            state: Arc::new(Mutex::new(self.state().clone())),
            ..*self
        }
    }

    fn state(&self) -> MutexGuard<'_, MindState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Lets N minds decide at once, each from a row of the observations, (N, OBSERVATION_SIZE); the numbers of
/// their actions. At most `threads` of them decide at the same time. `PhaseError` for an invalid row.
#[pyfunction]
pub(crate) fn decide_all<'py>(
    py: Python<'py>,
    minds: Vec<PyRef<'py, Mind>>,
    observations: &Bound<'py, PyArray2<f32>>,
    threads: usize,
) -> PyResult<Bound<'py, PyArray1<i64>>> {
    let observations = reading("observations", observations, &[minds.len(), SIZE])?;
    let numbers = rows(&observations);
    let read = minds.iter().zip(numbers.chunks_exact(SIZE));
    let tasks: Vec<(Arc<Mutex<MindState>>, Observation)> = read
        .map(|(mind, row)| Ok((Arc::clone(&mind.state), vector::read(mind.agent, row).map_err(raise)?)))
        .collect::<PyResult<_>>()?;
    let pool = pool(py, threads)?;
    let decided: Result<Vec<i64>, String> = py.detach(|| {
        let one = |(state, observation): &(Arc<Mutex<MindState>>, Observation)| {
            let mut state = state.lock().unwrap_or_else(PoisonError::into_inner);
            state.decide(observation, None).map(|action| action.index() as i64)
        };
        pool.install(|| tasks.par_iter().map(one).collect())
    });
    decided.map(|actions| PyArray1::from_vec(py, actions)).map_err(raise)
}

/// The parameters of a mind that decides from observations.
///
/// # Errors
/// `PhaseError` that names the parameter and the rule, and for another kind of mind.
fn own_parameters(text: Option<&str>) -> PyResult<MindParameters> {
    let parameters = read_parameters(text)?;
    if parameters.kind() == MindKind::Phase {
        return Ok(parameters);
    }
    Err(raise(
        "a mind that decides from observations is of the kind phase: published minds have senses of their own",
    ))
}

/// The parameters of minds as a JSON object, of which all that are absent have their defaults.
///
/// # Errors
/// `PhaseError` that names the parameter and the rule.
pub(crate) fn read_parameters(text: Option<&str>) -> PyResult<MindParameters> {
    let Some(text) = text else { return Ok(MindParameters::default()) };
    let given = parse_as(text).map_err(raise)?;
    MindParameters::from_overrides(given).map_err(raise)
}
