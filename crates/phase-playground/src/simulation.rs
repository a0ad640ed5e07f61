//! A scene that is simulated step by step.

use crate::{GENERATOR, packed, scenes, sentence};
use phase_event::{Recording, mean_state, to_json};
use phase_minds::MindParameters;
use phase_model::{AGENT_COUNT, Action, AgentId, PhysicsConfig};
use phase_perception::{Cell, observe};
use phase_predicates::achieved;
use phase_sim::{Engine, SimulationSettings};
use serde::Deserialize;
use serde_json::{Value, json};

/// A page's simulation: a scene with its minds, which exchanges JSON and packed states.
#[derive(Debug)]
pub struct PageSimulation {
    simulation: phase_sim::Simulation,
    settings: SimulationSettings,
    physics: PhysicsConfig,
}

/// The settings of a page's simulation, all of them optional.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Options {
    #[serde(default)]
    engine: Engine,
    max_steps: Option<usize>,
    min_steps: Option<usize>,
    minds: Option<Value>,
}

impl PageSimulation {
    /// A scene at its start. `options` is an object with `engine`, `max_steps`, `min_steps` and `minds`,
    /// parameters of the minds that differ from the defaults; all are optional.
    ///
    /// # Errors
    /// A sentence that names the field and the rule.
    pub fn new(scene: &str, seed: u64, options: &str) -> Result<Self, String> {
        let scene = scenes::read(scene)?;
        let options: Options = phase_model::json::parse_as(options).map_err(sentence)?;
        let minds =
            options.minds.map_or_else(|| Ok(MindParameters::default()), MindParameters::from_overrides);
        let default = SimulationSettings::default();
        let settings = SimulationSettings {
            engine: options.engine,
            max_steps: options.max_steps.unwrap_or(default.max_steps),
            min_steps: options.min_steps.unwrap_or(default.min_steps),
            minds: minds.map_err(sentence)?,
            ..default
        };
        let simulation = phase_sim::Simulation::new(&scene, seed, &settings).map_err(sentence)?;
        Ok(Self { simulation, settings, physics: scene.physics() })
    }

    /// One step. An agent for which an action is given carries that out; the others' minds decide.
    ///
    /// # Errors
    /// If the search fails.
    pub fn step(&mut self, given: [Option<Action>; AGENT_COUNT]) -> Result<(), String> {
        self.simulation.step(given).map(|_| ()).map_err(sentence)
    }

    /// Whether nothing more happens.
    #[must_use]
    pub const fn is_over(&self) -> bool {
        self.simulation.is_over()
    }

    /// The states after each substep of the last step, packed; before the first one the initial state.
    #[must_use]
    pub fn frames(&self) -> Vec<f32> {
        let mut numbers = Vec::new();
        match self.simulation.event().steps.last() {
            Some(step) => step.substeps.iter().for_each(|state| packed::push(state, &mut numbers)),
            None => packed::push(self.simulation.state(), &mut numbers),
        }
        numbers
    }

    /// The row of the last step that an observer is shown, packed: the mean over its substeps; before the
    /// first one the initial state.
    #[must_use]
    pub fn row(&self) -> Vec<f32> {
        let event = self.simulation.event();
        let mut numbers = Vec::new();
        packed::push(&event.steps.last().map_or(event.initial, mean_state), &mut numbers);
        numbers
    }

    /// The last step in words: `step`, its number; `over`; `actions`; `goals`, which hold now; and `minds`,
    /// the thoughts of both agents (`subgoal`, `subgoals`, `plan`, `actions`), all before the first step
    /// without actions and minds.
    #[must_use]
    pub fn report(&self) -> String {
        let event = self.simulation.event();
        let holds = event.scene.goals().map(|goal| achieved(&self.physics, self.simulation.state(), goal));
        let last = event.steps.last();
        json!({
            "step": event.steps.len(), "over": self.simulation.is_over(), "goals": holds,
            "actions": last.map(|step| step.actions),
            "minds": last.map(|step| step.thoughts.each_ref().map(phase_event::Thought::described)),
        })
        .to_string()
    }

    /// The particles of an agent's belief, packed one after the other.
    #[must_use]
    pub fn belief(&self, agent: AgentId) -> Vec<f32> {
        let mut numbers = Vec::new();
        self.simulation.particles(agent).iter().for_each(|state| packed::push(state, &mut numbers));
        numbers
    }

    /// The cells that an agent sees, 1 for each that it does, from the bottom left, row by row.
    #[must_use]
    pub fn view(&self, agent: AgentId) -> Vec<u8> {
        let observation = observe(&self.physics, self.simulation.state(), agent);
        Cell::all().map(|cell| u8::from(observation.visible.contains(cell))).collect()
    }

    /// The event so far, as a file in the format `phase-events/1`.
    ///
    /// # Errors
    /// If the id is not valid.
    pub fn document(&self, id: &str) -> Result<String, String> {
        let settings = serde_json::to_value(self.settings).map_err(sentence)?;
        let event = self.simulation.event().clone();
        to_json(&[Recording::of_event(id, event, GENERATOR.into(), settings)]).map_err(sentence)
    }
}
