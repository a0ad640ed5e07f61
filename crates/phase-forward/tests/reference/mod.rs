//! Reading the reference material, which lies beside the project where it is available at all.

use phase_forward::{Forward, Memory};
use phase_model::{Action, AgentBody, Body, Physique, Segment, State, Vec2};
use serde_json::Value;
use std::path::Path;

/// A file of the reference material, or `None` (saying so) where there is none.
pub(crate) fn read(path: &str) -> Option<Value> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared").join(path);
    let Ok(text) = std::fs::read_to_string(&path) else {
        println!("skipped: there is no reference material beside the project");
        return None;
    };
    Some(serde_json::from_str(&text).expect("valid JSON"))
}

pub(crate) fn number(value: &Value) -> f32 {
    value.as_f64().expect("a number") as f32
}

pub(crate) fn numbers(value: &Value) -> Vec<f32> {
    value.as_array().expect("a list").iter().map(number).collect()
}

pub(crate) fn walls(value: &Value) -> Vec<Segment> {
    let point = |value: &Value| Vec2::new(number(&value[0]), number(&value[1]));
    value
        .as_array()
        .expect("a list")
        .iter()
        .map(|wall| Segment { a: point(&wall[0]), b: point(&wall[1]) })
        .collect()
}

pub(crate) fn action(value: &Value) -> Action {
    Action::ALL
        .into_iter()
        .find(|action| action.name() == value.as_str().expect("a name"))
        .expect("an action")
}

/// A body from a row x, y, vx, vy, angle and perhaps angular velocity.
pub(crate) fn body(row: &Value) -> Body {
    let row = numbers(row);
    Body {
        position: Vec2::new(row[0], row[1]),
        velocity: Vec2::new(row[2], row[3]),
        angle: row[4],
        angular_velocity: row.get(5).copied().unwrap_or(0.0),
    }
}

/// The bodies of one row of states.
pub(crate) fn state(rows: &Value) -> State {
    State::new(core::array::from_fn(|entity| body(&rows[entity])))
}

pub(crate) fn physique(walls: Vec<Segment>, radii: &[f32], max_force: &[f32]) -> Physique {
    Physique {
        walls,
        agents: core::array::from_fn(|k| AgentBody { radius: radii[k], max_force: max_force[k] }),
        object_radii: [radii[2], radii[3]],
        object_count: 2,
    }
}

/// The largest distance between bodies of two states (u).
pub(crate) fn distance(a: &State, b: &State) -> f32 {
    a.bodies.iter().zip(&b.bodies).map(|(a, b)| a.position.distance(b.position)).fold(0.0, f32::max)
}

/// The p-th percentile (0 to 100) of some errors.
pub(crate) fn percentile(errors: &mut [f32], p: usize) -> f32 {
    errors.sort_by(f32::total_cmp);
    if errors.is_empty() { 0.0 } else { errors[(errors.len() - 1) * p / 100] }
}

/// A freshly set-up world after its idle substep, with its memory.
pub(crate) fn set_up(forward: &Forward, mut state: State) -> (State, Memory) {
    let mut memory = forward.remember(&state);
    forward.settle_warm(&mut state, &mut memory);
    (state, memory)
}
