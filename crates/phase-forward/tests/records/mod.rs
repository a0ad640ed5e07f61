//! The kernel as something that can be held against records, and the records, where they are at hand.

use phase_calibration::Engine;
use phase_forward::{Forward, Memory};
use phase_model::{AGENT_COUNT, Action, Physique, State, Vec2, arena::SUBSTEPS};
use std::path::{Path, PathBuf};

/// A file of the reference material beside the project, or `None` (saying so) where there is none.
pub(crate) fn path(file: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared").join(file);
    if !path.is_file() {
        println!("skipped: there is no reference material beside the project");
        return None;
    }
    Some(path)
}

/// The text of such a file.
pub(crate) fn text(file: &str) -> Option<String> {
    Some(std::fs::read_to_string(path(file)?).expect("a readable file"))
}

/// The kernel with its memory.
pub(crate) struct Warm {
    pub(crate) forward: Forward,
    pub(crate) state: State,
    pub(crate) memory: Memory,
}

impl Engine for Warm {
    const THROUGH_IDLE: bool = true;

    fn set_up(physique: &Physique, state: &State) -> Self {
        let forward = Forward::new(physique);
        let memory = forward.remember(state);
        Self { forward, state: *state, memory }
    }

    fn settle(&mut self) {
        self.forward.settle_warm(&mut self.state, &mut self.memory);
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        self.state.bodies[body].velocity = velocity;
    }

    fn state(&self) -> State {
        self.state
    }

    fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        self.forward.step_warm(&mut self.state, &mut self.memory, actions)
    }
}

/// The kernel from the state alone.
pub(crate) struct Cold {
    forward: Forward,
    state: State,
}

impl Engine for Cold {
    const THROUGH_IDLE: bool = true;

    fn set_up(physique: &Physique, state: &State) -> Self {
        Self { forward: Forward::new(physique), state: *state }
    }

    fn settle(&mut self) {
        self.forward.settle(&mut self.state);
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        self.state.bodies[body].velocity = velocity;
    }

    fn state(&self) -> State {
        self.state
    }

    fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        self.forward.step_substeps(&mut self.state, actions)
    }
}
