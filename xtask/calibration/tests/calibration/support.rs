//! Small records, and an engine that drifts by a known amount.

use phase_calibration::Engine;
use phase_model::{AGENT_COUNT, Action, PhysicsConfig, State, Vec2, arena::SUBSTEPS};
use serde_json::{Value, json};

/// Four bodies at rest: x, y and four zeros.
pub(crate) fn still() -> Value {
    json!([[8, 12, 0, 0, 0, 0], [24, 12, 0, 0, 0, 0], [12, 4, 0, 0, 0, 0], [20, 20, 0, 0, 0, 0]])
}

/// A probe of two steps in which nothing moves and agent 1 ends up holding object 0.
pub(crate) fn probe(name: &str) -> Value {
    let rows = |entity: usize| vec![json!(still()[entity].as_array().expect("a row")[..5]); 11];
    json!({
        "name": name, "wall_segs": [[[16, 12], [16, 22]]], "sizes": [0.8, 1.2, 0.8, 1.6],
        "max_force": [150, 600], "init_velocities": null, "actions": [["stop", "up"], ["noforce", "attach"]],
        "initial": still(), "steps": [still(), still()], "substeps": [rows(0), rows(1), rows(2), rows(3)],
        "attached_after_step": [[null, null], [null, 0]],
    })
}

/// A run of some steps in which nothing moves.
pub(crate) fn run(name: &str, steps: usize) -> Value {
    json!({
        "name": name, "walls": [], "radii": [0.8, 1.2, 0.8, 1.6], "max_force": [150, 600],
        "actions": [vec!["stop"; steps], vec!["noforce"; steps]],
        "states": vec![still(); steps + 1], "attached_after_step": vec![[Value::Null, Value::Null]; steps],
    })
}

pub(crate) fn probes(entries: &[Value]) -> String {
    json!({ "probes": entries }).to_string()
}

pub(crate) fn runs(entries: &[Value]) -> String {
    json!({ "runs": entries }).to_string()
}

/// An engine in which agent 0 moves 0.25 u to the right in every substep, the idle one too, and agent 1 turns
/// by 0.5 rad in every step. No agent ever grabs anything.
pub(crate) struct Drifting<const RUNS_IDLE_SUBSTEP: bool>(State);

/// Displacement of agent 0 in a substep (u).
pub(crate) const DRIFT: f32 = 0.25;

impl<const RUNS_IDLE_SUBSTEP: bool> Engine for Drifting<RUNS_IDLE_SUBSTEP> {
    const RUNS_IDLE_SUBSTEP: bool = RUNS_IDLE_SUBSTEP;

    fn set_up(_: &PhysicsConfig, state: &State) -> Self {
        Self(*state)
    }

    fn settle(&mut self) {
        self.0.bodies[0].position.x += DRIFT;
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        self.0.bodies[body].velocity = velocity;
    }

    fn state(&self) -> State {
        self.0
    }

    fn step(&mut self, _: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        self.0.bodies[1].angle -= 0.5;
        core::array::from_fn(|_| {
            self.0.bodies[0].position.x += DRIFT;
            self.0
        })
    }
}
