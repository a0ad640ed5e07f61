//! Scenes: read, written, sampled.

use crate::error::raise;
use phase_eval::goals::canonical;
use phase_model::{Action, AgentId, Goal, LandmarkId, ObjectId, Scene as ModelScene, Sign, json};
use phase_runs::gen_dataset::{any_scene, plan};
use phase_sampler::sample_named;
use pyo3::prelude::*;

/// A valid scene: walls, bodies, goals and attitudes. `phase_events.scene` makes one of a description,
/// `phase_events.sample_scene` draws one. It does not change.
#[pyclass(frozen, module = "phase_events._native")]
pub(crate) struct Scene {
    pub(crate) scene: ModelScene,
}

#[pymethods]
impl Scene {
    /// Reads a scene as JSON, as it stands in a file of events. `PhaseError` names the field and the rule if
    /// it is none.
    #[staticmethod]
    fn from_json(text: &str) -> PyResult<Self> {
        let scene = ModelScene::from_json(text).map_err(raise)?;
        scene.validate().map_err(raise)?;
        Ok(Self { scene })
    }

    /// As `from_json`.
    #[new]
    fn new(text: &str) -> PyResult<Self> {
        Self::from_json(text)
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

    /// Draws a scene of a kind and a variant, of a kind, or of any of the six kinds, from a seed of 64 bits.
    /// `PhaseError` for unknown names, and if no scene was found.
    #[staticmethod]
    #[pyo3(signature = (kind, variant, seed))]
    fn sample(py: Python<'_>, kind: Option<&str>, variant: Option<&str>, seed: u64) -> PyResult<Self> {
        let scene = py.detach(|| sample_named(kind, variant, seed));
        Ok(Self { scene: scene.map_err(raise)? })
    }

    /// Draws a scene as a preset has them: of a random one of its slots, with that slot's variant, goals and
    /// layouts. `PhaseError` for an unknown preset or an invalid file, and if no scene was found.
    #[staticmethod]
    fn sample_preset(py: Python<'_>, preset: &str, seed: u64) -> PyResult<Self> {
        let preset = plan::preset(preset).map_err(raise)?;
        let scene = py.detach(|| any_scene(&preset, seed));
        Ok(Self { scene: scene.map_err(raise)? })
    }

    /// The scene as JSON, as it stands in a file of events.
    fn to_json(&self) -> PyResult<String> {
        self.scene.to_json().map_err(raise)
    }

    /// The scene as a dict, as it stands in a file of events.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("json")?.call_method1("loads", (self.to_json()?,))
    }

    /// The kind of event that it was made for: `helping`, `hindering`, `chasing`, `competing`,
    /// `collaborating` or `independent`.
    #[getter]
    const fn kind(&self) -> &'static str {
        self.scene.kind.name()
    }

    /// The relation that its goals and attitudes make: `friendly`, `adversarial` or `neutral`.
    #[getter]
    fn relation(&self) -> &'static str {
        self.scene.relation().name()
    }

    /// The number of bodies: two agents and up to two objects.
    #[getter]
    fn entity_count(&self) -> usize {
        self.scene.physics().entities().count()
    }
}

/// Names of the fourteen actions, by their numbers.
pub(crate) fn action_names() -> Vec<String> {
    let name = |action: Action| serde_json::to_value(action).ok()?.as_str().map(str::to_owned);
    Action::ALL.into_iter().filter_map(name).collect()
}

/// The goals that methods tell apart, in their canonical form: 17 to be achieved, and the same to be avoided.
pub(crate) fn all_goals() -> Vec<Goal> {
    let sign = Sign::Positive;
    let mut goals = Vec::new();
    for agent in AgentId::ALL {
        goals.extend(LandmarkId::ALL.map(|landmark| Goal::AgentOnLandmark { agent, landmark, sign }));
    }
    for object in ObjectId::ALL {
        goals.extend(LandmarkId::ALL.map(|landmark| Goal::ObjectOnLandmark { object, landmark, sign }));
    }
    goals.push(Goal::Touch { agent: AgentId::ZERO, other: AgentId::ONE, sign });
    let avoided: Vec<Goal> = goals.iter().map(|goal| goal.negated()).collect();
    goals.into_iter().chain(avoided).collect()
}

/// [`all_goals`] as JSON.
pub(crate) fn goals_as_json() -> PyResult<String> {
    serde_json::to_string(&all_goals()).map_err(raise)
}

/// The index of a goal, given as JSON, among [`all_goals`]. `PhaseError` if it is none.
#[pyfunction]
pub(crate) fn goal_index(goal: &str) -> PyResult<usize> {
    let goal: Goal = json::parse_as(goal).map_err(|error| raise(format!("goal: {error}")))?;
    number_of(goal).ok_or_else(|| raise("goal: an agent cannot touch itself"))
}

/// The index of a goal among [`all_goals`].
pub(crate) fn number_of(goal: Goal) -> Option<usize> {
    all_goals().into_iter().position(|other| other == canonical(goal))
}

/// An agent by its number.
///
/// # Errors
/// `PhaseError` for a number other than 0 and 1.
pub(crate) fn agent_of(number: usize) -> PyResult<AgentId> {
    let agent = AgentId::ALL.get(number).copied();
    agent.ok_or_else(|| raise(format!("an agent is 0 or 1, not {number}")))
}

/// An action by its number.
///
/// # Errors
/// `PhaseError` for a number past 13 or below 0.
pub(crate) fn action_of(number: i64) -> PyResult<Action> {
    let action = usize::try_from(number).ok().and_then(|number| Action::ALL.get(number)).copied();
    action.ok_or_else(|| raise(format!("an action is a whole number from 0 to 13, not {number}")))
}
