//! What JavaScript calls. Errors are exceptions with the sentence as their message.

use crate::{PageObserver, PageSimulation, packed, scenes};
use phase_model::{AGENT_COUNT, Action, AgentId};
use wasm_bindgen::prelude::*;

fn raise(sentence: String) -> JsError {
    JsError::new(&sentence)
}

fn agent_of(number: u32) -> Result<AgentId, JsError> {
    AgentId::ALL.get(number as usize).copied().ok_or_else(|| JsError::new("an agent is 0 or 1"))
}

/// An action by its number; a negative number stands for the mind's own.
fn action_of(number: i32) -> Result<Option<Action>, JsError> {
    match usize::try_from(number) {
        Err(_) => Ok(None),
        Ok(index) => {
            let action = Action::ALL.get(index).copied();
            action.map(Some).ok_or_else(|| JsError::new("an action is a number from 0 to 13"))
        }
    }
}

/// Numbers of a packed state.
#[wasm_bindgen(js_name = stateLength)]
pub fn state_length() -> usize {
    packed::STATE
}

/// Names of the fourteen actions, by their numbers.
#[wasm_bindgen]
pub fn actions() -> Vec<String> {
    let name = |action: &Action| serde_json::to_value(action).ok()?.as_str().map(str::to_owned);
    Action::ALL.iter().filter_map(name).collect()
}

/// As [`scenes::choices`].
#[wasm_bindgen]
pub fn choices() -> String {
    scenes::choices()
}

/// As [`scenes::goals`].
#[wasm_bindgen]
pub fn goals(agent: u32, objects: usize) -> Result<String, JsError> {
    Ok(scenes::goals(agent_of(agent)?, objects))
}

/// As [`scenes::describe`].
#[wasm_bindgen(js_name = describeScene)]
pub fn describe_scene(scene: &str) -> Result<String, JsError> {
    scenes::describe(scene).map_err(raise)
}

/// As [`scenes::sample`].
#[wasm_bindgen(js_name = sampleScene)]
pub fn sample_scene(kind: &str, variant: Option<String>, seed: u64) -> Result<String, JsError> {
    scenes::sample(kind, variant.as_deref(), seed).map_err(raise)
}

/// As [`scenes::start`].
#[wasm_bindgen(js_name = startState)]
pub fn start_state(scene: &str) -> Result<Vec<f32>, JsError> {
    scenes::start(scene).map_err(raise)
}

/// Events of a file.
#[wasm_bindgen]
pub struct Events(Vec<phase_event::Recording>);

#[wasm_bindgen]
impl Events {
    /// Reads a file in the format `phase-events/1`.
    #[wasm_bindgen(constructor)]
    pub fn new(text: &str) -> Result<Events, JsError> {
        scenes::events(text).map(Self).map_err(raise)
    }

    /// How many there are.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.0.len()
    }

    /// Id of an event.
    pub fn id(&self, index: usize) -> Option<String> {
        self.0.get(index).map(|recording| recording.id.clone())
    }

    /// Scene of an event, as JSON.
    pub fn scene(&self, index: usize) -> Option<String> {
        self.0.get(index).and_then(|recording| recording.scene.to_json().ok())
    }

    /// As [`scenes::frames`].
    pub fn frames(&self, index: usize) -> Option<Vec<f32>> {
        self.0.get(index).map(scenes::frames)
    }

    /// The rows that an observer is shown, packed.
    pub fn rows(&self, index: usize) -> Option<Vec<f32>> {
        self.0.get(index).map(|recording| {
            let mut numbers = Vec::new();
            recording.trajectory.states().iter().for_each(|state| packed::push(state, &mut numbers));
            numbers
        })
    }
}

/// As [`PageSimulation`].
#[wasm_bindgen]
pub struct Simulation(PageSimulation);

#[wasm_bindgen]
impl Simulation {
    /// As [`PageSimulation::new`].
    #[wasm_bindgen(constructor)]
    pub fn new(scene: &str, seed: u64, options: &str) -> Result<Simulation, JsError> {
        PageSimulation::new(scene, seed, options).map(Self).map_err(raise)
    }

    /// As [`PageSimulation::step`]; a negative number leaves the agent to its mind.
    pub fn step(&mut self, first: i32, second: i32) -> Result<(), JsError> {
        let given: [Option<Action>; AGENT_COUNT] = [action_of(first)?, action_of(second)?];
        self.0.step(given).map_err(raise)
    }

    /// As [`PageSimulation::frames`].
    pub fn frames(&self) -> Vec<f32> {
        self.0.frames()
    }

    /// As [`PageSimulation::row`].
    pub fn row(&self) -> Vec<f32> {
        self.0.row()
    }

    /// As [`PageSimulation::report`].
    pub fn report(&self) -> String {
        self.0.report()
    }

    /// As [`PageSimulation::belief`].
    pub fn belief(&self, agent: u32) -> Result<Vec<f32>, JsError> {
        Ok(self.0.belief(agent_of(agent)?))
    }

    /// As [`PageSimulation::view`].
    pub fn view(&self, agent: u32) -> Result<Vec<u8>, JsError> {
        Ok(self.0.view(agent_of(agent)?))
    }

    /// As [`PageSimulation::document`].
    pub fn document(&self, id: &str) -> Result<String, JsError> {
        self.0.document(id).map_err(raise)
    }
}

/// Infers goals, relation and roles from an event row by row; a [`PageObserver`] for JavaScript.
#[wasm_bindgen]
pub struct Observer(PageObserver);

#[wasm_bindgen]
impl Observer {
    /// As [`PageObserver::new`].
    #[wasm_bindgen(constructor)]
    pub fn new(scene: &str, row: &[f32], decisions: usize) -> Result<Observer, JsError> {
        PageObserver::new(scene, row, decisions).map(Self).map_err(raise)
    }

    /// As [`PageObserver::push`].
    pub fn push(&mut self, row: &[f32]) -> Result<String, JsError> {
        self.0.push(row).map_err(raise)
    }
}

/// As [`crate::Picture`].
#[wasm_bindgen]
pub struct Picture(crate::Picture);

#[wasm_bindgen]
impl Picture {
    /// As [`crate::Picture::new`].
    #[wasm_bindgen(constructor)]
    pub fn new(scene: &str, side: u32, palette: &str) -> Result<Picture, JsError> {
        crate::Picture::new(scene, side, palette).map(Self).map_err(raise)
    }

    /// Width (pixels).
    #[wasm_bindgen(getter)]
    pub fn width(&self) -> u32 {
        self.0.size()[0]
    }

    /// Height (pixels).
    #[wasm_bindgen(getter)]
    pub fn height(&self) -> u32 {
        self.0.size()[1]
    }

    /// As [`crate::Picture::show_mind`].
    #[wasm_bindgen(js_name = showMind)]
    pub fn show_mind(&mut self, agent: u32, view: &[u8], belief: &[f32]) -> Result<(), JsError> {
        self.0.show_mind(agent_of(agent)?, view, belief);
        Ok(())
    }

    /// As [`crate::Picture::hide_mind`].
    #[wasm_bindgen(js_name = hideMind)]
    pub fn hide_mind(&mut self) {
        self.0.hide_mind();
    }

    /// As [`crate::Picture::draw`].
    pub fn draw(&self, state: &[f32]) -> Result<Vec<u8>, JsError> {
        self.0.draw(state).map_err(raise)
    }

    /// As [`crate::Picture::pixel`].
    pub fn pixel(&self, x: f32, y: f32) -> Vec<f32> {
        self.0.pixel(x, y).to_vec()
    }
}
