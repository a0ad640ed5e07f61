//! The functions and classes that JavaScript calls. Errors are exceptions with the sentence as their message.

use crate::{PageObserver, PageSimulation, PageTracker, packed, scenes};
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

/// The choices that an editor offers, as JSON; see [`scenes::choices`].
#[wasm_bindgen]
pub fn choices() -> String {
    scenes::choices()
}

/// The goals that an agent can have, as JSON; see [`scenes::goals`].
#[wasm_bindgen]
pub fn goals(agent: u32, objects: usize) -> Result<String, JsError> {
    Ok(scenes::goals(agent_of(agent)?, objects))
}

/// Checks and describes a scene, as JSON; see [`scenes::describe`].
#[wasm_bindgen(js_name = describeScene)]
pub fn describe_scene(scene: &str) -> Result<String, JsError> {
    scenes::describe(scene).map_err(raise)
}

/// Samples a scene of a kind or variant; see [`scenes::sample`].
#[wasm_bindgen(js_name = sampleScene)]
pub fn sample_scene(kind: &str, variant: Option<String>, seed: u64) -> Result<String, JsError> {
    scenes::sample(kind, variant.as_deref(), seed).map_err(raise)
}

/// The initial state of a scene, packed; see [`scenes::start`].
#[wasm_bindgen(js_name = startState)]
pub fn start_state(scene: &str) -> Result<Vec<f32>, JsError> {
    scenes::start(scene).map_err(raise)
}

/// Events of a file.
#[wasm_bindgen]
pub struct Events(Vec<scenes::PageEvent>);

#[wasm_bindgen]
impl Events {
    /// Reads a file in the format `phase-events/1`, with labels or without.
    #[wasm_bindgen(constructor)]
    pub fn new(text: &str) -> Result<Events, JsError> {
        scenes::events(text).map(Self).map_err(raise)
    }

    /// Number of events.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.0.len()
    }

    /// Id of an event.
    pub fn id(&self, index: usize) -> Option<String> {
        self.0.get(index).map(|event| event.id.clone())
    }

    /// Whether an event has labels.
    pub fn labelled(&self, index: usize) -> bool {
        self.0.get(index).is_some_and(|event| event.labelled)
    }

    /// Scene of an event, as JSON.
    pub fn scene(&self, index: usize) -> Option<String> {
        self.0.get(index).map(|event| event.scene.clone())
    }

    /// The states of an event, packed, to be shown one after the other; see [`scenes::frames`].
    pub fn frames(&self, index: usize) -> Option<Vec<f32>> {
        self.0.get(index).map(|event| event.frames.clone())
    }

    /// The rows that an observer is shown, packed.
    pub fn rows(&self, index: usize) -> Option<Vec<f32>> {
        self.0.get(index).map(|event| event.rows.clone())
    }
}

/// Reads a video picture by picture; a [`PageTracker`] for JavaScript.
#[wasm_bindgen]
#[derive(Default)]
pub struct VideoTracker(PageTracker);

#[wasm_bindgen]
impl VideoTracker {
    /// A tracker that has seen nothing.
    #[wasm_bindgen(constructor)]
    pub fn new() -> VideoTracker {
        Self::default()
    }

    /// Takes the next picture of a pass; see [`PageTracker::push`].
    pub fn push(&mut self, width: usize, height: usize, rgba: &[u8], seconds: f64) -> Result<(), JsError> {
        self.0.push(width, height, rgba, seconds).map_err(raise)
    }

    /// Ends a pass; see [`PageTracker::finish`].
    pub fn finish(&mut self, id: &str) -> Result<Option<String>, JsError> {
        self.0.finish(id).map_err(raise)
    }
}

/// Simulates a scene step by step; a [`PageSimulation`] for JavaScript.
#[wasm_bindgen]
pub struct Simulation(PageSimulation);

#[wasm_bindgen]
impl Simulation {
    /// Puts a scene at its start; see [`PageSimulation::new`] for the options.
    #[wasm_bindgen(constructor)]
    pub fn new(scene: &str, seed: u64, options: &str) -> Result<Simulation, JsError> {
        PageSimulation::new(scene, seed, options).map(Self).map_err(raise)
    }

    /// Simulates one step with these actions; a negative number leaves the agent to its mind.
    pub fn step(&mut self, first: i32, second: i32) -> Result<(), JsError> {
        let given: [Option<Action>; AGENT_COUNT] = [action_of(first)?, action_of(second)?];
        self.0.step(given).map_err(raise)
    }

    /// The states after each substep of the last step, packed.
    pub fn frames(&self) -> Vec<f32> {
        self.0.frames()
    }

    /// The row of the last step that an observer is shown, packed.
    pub fn row(&self) -> Vec<f32> {
        self.0.row()
    }

    /// The last step in words, as JSON; see [`PageSimulation::report`].
    pub fn report(&self) -> String {
        self.0.report()
    }

    /// The particles of an agent's belief, packed one after the other.
    pub fn belief(&self, agent: u32) -> Result<Vec<f32>, JsError> {
        Ok(self.0.belief(agent_of(agent)?))
    }

    /// The cells that an agent sees, 1 for each that it does; see [`PageSimulation::view`].
    pub fn view(&self, agent: u32) -> Result<Vec<u8>, JsError> {
        Ok(self.0.view(agent_of(agent)?))
    }

    /// The event so far, as a file in the format `phase-events/1`.
    pub fn document(&self, id: &str) -> Result<String, JsError> {
        self.0.document(id).map_err(raise)
    }
}

/// Infers goals, relation and roles from an event row by row; a [`PageObserver`] for JavaScript.
#[wasm_bindgen]
pub struct Observer(PageObserver);

#[wasm_bindgen]
impl Observer {
    /// Begins with the first row; see [`PageObserver::new`].
    #[wasm_bindgen(constructor)]
    pub fn new(scene: &str, row: &[f32], decisions: usize) -> Result<Observer, JsError> {
        PageObserver::new(scene, row, decisions).map(Self).map_err(raise)
    }

    /// Begins with the first row of an event of a file; see [`PageObserver::of_event`].
    #[wasm_bindgen(js_name = ofEvent)]
    pub fn of_event(file: &str, index: usize, decisions: usize) -> Result<Observer, JsError> {
        PageObserver::of_event(file, index, decisions).map(Self).map_err(raise)
    }

    /// Watches the next row and answers, as JSON; see [`PageObserver::push`].
    pub fn push(&mut self, row: &[f32]) -> Result<String, JsError> {
        self.0.push(row).map_err(raise)
    }
}

/// Draws states of one scene; a [`crate::Picture`] for JavaScript.
#[wasm_bindgen]
pub struct Picture(crate::Picture);

#[wasm_bindgen]
impl Picture {
    /// Prepares to draw a scene; see [`crate::Picture::new`].
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

    /// Draws the view and the belief of an agent over the states to come.
    #[wasm_bindgen(js_name = showMind)]
    pub fn show_mind(&mut self, agent: u32, view: &[u8], belief: &[f32]) -> Result<(), JsError> {
        self.0.show_mind(agent_of(agent)?, view, belief);
        Ok(())
    }

    /// Draws the states to come alone.
    #[wasm_bindgen(js_name = hideMind)]
    pub fn hide_mind(&mut self) {
        self.0.hide_mind();
    }

    /// The picture of a packed state: red, green, blue and opacity of each pixel, row by row from the top.
    pub fn draw(&self, state: &[f32]) -> Result<Vec<u8>, JsError> {
        self.0.draw(state).map_err(raise)
    }

    /// The pixel at which a place of the arena (u) is drawn.
    pub fn pixel(&self, x: f32, y: f32) -> Vec<f32> {
        self.0.pixel(x, y).to_vec()
    }
}
