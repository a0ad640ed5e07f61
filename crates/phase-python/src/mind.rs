//! A mind that decides from observations.

use crate::{
    arrays::{BODY_COLUMNS, check_shape, row_of},
    error::raise,
    scene::{Scene, action_of, agent_of},
};
use numpy::{PyArray1, PyArray3, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use phase_event::Thought;
use phase_minds::{Agent, MindKind, MindParameters};
use phase_model::{
    Action, AgentId,
    random::{self, Pcg64Mcg, Purpose},
};
use phase_perception::Observation;
use phase_sim::vector::{self, SIZE};
use pyo3::prelude::*;
use rayon::prelude::*;
use std::sync::{Arc, Mutex, PoisonError};

/// The mind of one agent, with its belief, of the kind `phase`. Users see it as `phase_events.Mind`.
#[pyclass(frozen, module = "phase_events._native")]
pub(crate) struct Mind {
    agent: AgentId,
    entities: usize,
    state: Arc<Mutex<MindState>>,
}

/// The parts of a mind that change as it observes and decides.
struct MindState {
    scene: phase_model::Scene,
    parameters: MindParameters,
    /// The agent, from its first observation on.
    agent: Option<Agent>,
    belief_random: Pcg64Mcg,
    search_random: Pcg64Mcg,
    last_action: Option<Action>,
    thought: Option<Thought>,
}

impl MindState {
    fn decide(&mut self, observation: &Observation, action: Option<Action>) -> Result<Action, String> {
        let known = self.agent.take().zip(action.or(self.last_action));
        let agent = match known {
            Some((mut agent, action)) => {
                agent.perceive(action, observation, &[], &mut self.belief_random);
                self.last_action = Some(action);
                agent
            }
            None => Agent::new(&self.scene, &self.parameters, observation, None, &mut self.belief_random)
                .map_err(|error| error.to_string())?,
        };
        let agent = self.agent.insert(agent);
        let decided = agent.decide(&mut self.search_random);
        let (action, thought) = decided.map_err(|error| error.to_string())?;
        self.last_action = Some(action);
        self.thought = Some(thought);
        Ok(action)
    }
}

#[pymethods]
impl Mind {
    /// The mind of agent 0 or 1 in a scene. `parameters` is a JSON object of those that differ from the
    /// defaults. `PhaseError` for an invalid argument, and for parameters of another kind of mind.
    #[new]
    #[pyo3(signature = (scene, agent, seed, parameters))]
    fn new(scene: PyRef<'_, Scene>, agent: usize, seed: u64, parameters: Option<&str>) -> PyResult<Self> {
        let agent = agent_of(agent)?;
        let parameters = read_parameters(parameters)?;
        if parameters.kind() != MindKind::Phase {
            return Err(raise(
                "a mind that decides from observations is of the kind phase: published minds have senses of \
                 their own",
            ));
        }
        let scene = &scene.scene;
        let entities = scene.physics().entities().count();
        let state = MindState {
            scene: scene.clone(),
            parameters,
            agent: None,
            belief_random: random::stream(seed, Purpose::Belief, agent.number().into()),
            search_random: random::stream(seed, Purpose::Search, agent.number().into()),
            last_action: None,
            thought: None,
        };
        Ok(Self { agent, entities, state: Arc::new(Mutex::new(state)) })
    }

    /// Observes and decides; the number of the action. `observation` is (OBSERVATION_SIZE,); `action` is the
    /// one that the agent took since its last decision, if it is another than was decided. `PhaseError` for
    /// an invalid action, and for numbers that are no observation of this agent.
    #[pyo3(signature = (observation, action))]
    fn decide(
        &self,
        py: Python<'_>,
        observation: PyReadonlyArray1<'_, f32>,
        action: Option<i64>,
    ) -> PyResult<usize> {
        let action = action.map(action_of).transpose()?;
        let observation = vector::read(self.agent, observation.as_slice()?).map_err(raise)?;
        let decided = py.detach(|| {
            self.state.lock().unwrap_or_else(PoisonError::into_inner).decide(&observation, action)
        });
        decided.map(Action::index).map_err(raise)
    }

    /// The possible worlds, equally likely: (particles, entities, 6), columns x, y (u), angle (rad), vx, vy
    /// (u/s), angular velocity (rad/s); `None` before the first decision.
    fn particles<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray3<f32>>>> {
        let state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
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
        let state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(state.thought.as_ref().map(|thought| thought.described().to_string()))
    }
}

/// Lets N minds decide at once, each from a row of the observations, (N, OBSERVATION_SIZE); the numbers of
/// their actions. At most `threads` of them decide at the same time. `PhaseError` for an invalid row.
#[pyfunction]
pub(crate) fn decide_all<'py>(
    py: Python<'py>,
    minds: Vec<PyRef<'py, Mind>>,
    observations: PyReadonlyArray2<'py, f32>,
    threads: usize,
) -> PyResult<Bound<'py, PyArray1<i64>>> {
    check_shape("observations", observations.shape(), &[minds.len(), SIZE])?;
    let numbers = observations.as_slice()?;
    let rows = minds.iter().zip(numbers.chunks_exact(SIZE));
    let tasks: Vec<(Arc<Mutex<MindState>>, Observation)> = rows
        .map(|(mind, row)| Ok((Arc::clone(&mind.state), vector::read(mind.agent, row).map_err(raise)?)))
        .collect::<PyResult<_>>()?;
    let decided: Result<Vec<i64>, String> = py.detach(|| {
        let one = |(state, observation): &(Arc<Mutex<MindState>>, Observation)| {
            let mut state = state.lock().unwrap_or_else(PoisonError::into_inner);
            state.decide(observation, None).map(|action| action.index() as i64)
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.max(1)).build();
        let pool = pool.map_err(|error| error.to_string())?;
        pool.install(|| tasks.par_iter().map(one).collect())
    });
    decided.map(|actions| PyArray1::from_vec(py, actions)).map_err(raise)
}

/// The parameters of minds as a JSON object, of which all that are absent have their defaults.
///
/// # Errors
/// `PhaseError` that names the parameter and the rule.
pub(crate) fn read_parameters(text: Option<&str>) -> PyResult<MindParameters> {
    let Some(text) = text else { return Ok(MindParameters::default()) };
    let given = serde_json::from_str(text).map_err(raise)?;
    MindParameters::from_overrides(given).map_err(raise)
}
