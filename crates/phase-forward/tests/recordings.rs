//! Long runs of the published simulator, and real recordings whose actions are known.

mod reference;

use phase_forward::Forward;
use phase_model::{Action, Dynamics, Grip, Side, State, Vec2};
use reference::{action, body, distance, number, numbers, percentile, physique, read, set_up, state, walls};
use serde_json::Value;

/// For some steps ahead, what nine in ten predictions stay under (u): from a state alone and with the memory
/// of a world freshly set up in it.
const HORIZONS: [(usize, f32, f32); 2] = [(1, 0.002, 0.002), (10, 0.05, 0.02)];

#[test]
fn predictions_from_recorded_states_hold() {
    let Some(file) = read("reference/runs.json") else { return };
    for (horizon, cold_limit, warm_limit) in HORIZONS {
        let (mut cold, mut warm) = (Vec::new(), Vec::new());
        for run in file["runs"].as_array().expect("a list") {
            let forward = kernel(run);
            let recorded = recorded_states(run);
            for start in 1..recorded.len() - horizon {
                let (mut alone, mut remembered) = (recorded[start], recorded[start]);
                let mut memory = forward.remember(&remembered);
                for step in start..start + horizon {
                    forward.step(&mut alone, actions(run, step));
                    forward.step_warm(&mut remembered, &mut memory, actions(run, step));
                }
                cold.push(distance(&alone, &recorded[start + horizon]));
                warm.push(distance(&remembered, &recorded[start + horizon]));
            }
        }
        for (errors, limit, name) in
            [(&mut cold, cold_limit, "from a state alone"), (&mut warm, warm_limit, "with fresh memory")]
        {
            let [p50, p90, p99] = [50, 90, 99].map(|p| percentile(errors, p));
            println!(
                "{horizon} steps ahead {name}, {} starts: p50 {p50:.6} p90 {p90:.6} p99 {p99:.6}",
                errors.len()
            );
            assert!(p90 < limit);
        }
    }
}

#[test]
fn long_runs_are_followed() {
    /// What nine in ten steps stay under (u).
    const LIMIT: f32 = 1e-4;
    let Some(file) = read("reference/runs.json") else { return };
    let mut errors = Vec::new();
    for run in file["runs"].as_array().expect("a list") {
        let forward = kernel(run);
        let recorded = recorded_states(run);
        let (mut now, mut memory) = set_up(&forward, recorded[0]);
        // The memory goes on from step to step while the state is put back onto the record.
        for step in 0..recorded.len() - 1 {
            forward.step_warm(&mut now, &mut memory, actions(run, step));
            errors.push(distance(&now, &recorded[step + 1]));
            let grips = now.grips;
            now = recorded[step + 1];
            now.grips = grips;
        }
    }
    let [p50, p90, p99] = [50, 90, 99].map(|p| percentile(&mut errors, p));
    println!("one step ahead with true memory: p50 {p50:.6} p90 {p90:.6} p99 {p99:.6}");
    assert!(p90 < LIMIT);
}

#[test]
fn real_recordings_are_replayed() {
    /// The greatest error of any step's mean position, to the end of what is known (u).
    const LIMIT: f32 = 0.02;
    let Some(file) = read("real-phase/dev.json") else { return };
    for event in file["events"].as_array().expect("a list") {
        let Some(steps) = event["recovered_actions"]["steps"].as_array() else { continue };
        let of_all = |kinds: &[&str], field: &str| -> Vec<f32> {
            let entities = kinds.iter().flat_map(|kind| event[*kind].as_array().expect("a list"));
            entities.map(|entity| number(&entity[field])).collect()
        };
        let forward = Forward::new(&physique(
            walls(&event["walls"]),
            &of_all(&["agents", "objects"], "radius"),
            &of_all(&["agents"], "max_force"),
        ));
        let row = |step: usize| {
            let entity = |kind: &str, k: usize| body(&event["trajectory"][kind][k][step]);
            State::new([entity("agents", 0), entity("agents", 1), entity("objects", 0), entity("objects", 1)])
        };
        let (mut now, mut memory) = set_up(&forward, row(0));
        let mut worst = 0.0_f32;
        for (step, both) in steps.iter().enumerate() {
            let actions = [0, 1].map(|agent| left_only(action(&both[agent])));
            let substeps = forward.step_warm(&mut now, &mut memory, actions);
            let mut mean = now;
            for (entity, body) in mean.bodies.iter_mut().enumerate() {
                let sum: Vec2 = substeps.iter().map(|state| state.bodies[entity].position).sum();
                body.position = sum / substeps.len() as f32;
            }
            worst = worst.max(distance(&mean, &row(step + 1)));
        }
        println!("{}: {} steps, worst {worst:.6}", event["id"], steps.len());
        assert!(worst < LIMIT);
    }
}

/// The kernel of a run.
fn kernel(run: &Value) -> Forward {
    Forward::new(&physique(walls(&run["walls"]), &numbers(&run["radii"]), &numbers(&run["max_force"])))
}

/// Both actions of a step of a run.
fn actions(run: &Value, step: usize) -> [Action; 2] {
    [0, 1].map(|agent| action(&run["actions"][agent][step]))
}

/// The states of a run with the grips that go with them.
fn recorded_states(run: &Value) -> Vec<State> {
    let rows = run["states"].as_array().expect("a list");
    let held = run["attached_after_step"].as_array().expect("a list");
    core::iter::once(state(&rows[0]))
        .chain(rows[1..].iter().zip(held).map(|(row, held)| hold(state(row), held)))
        .collect()
}

/// A recorded state with the grips that the record says agents have, on the sides where objects lie.
fn hold(mut state: State, held: &Value) -> State {
    for agent in 0..2 {
        state.grips[agent] = held[agent].as_u64().map(|object| {
            let (holder, held) = (&state.bodies[agent], &state.bodies[2 + object as usize]);
            let between = held.position - holder.position;
            let right = Vec2::from_angle(holder.angle);
            let local = Vec2::new(between.dot(right), between.dot(right.perp()));
            let along = |side: &Side| side.direction().dot(local);
            let side = Side::ALL.into_iter().max_by(|a, b| along(a).total_cmp(&along(b)));
            Grip {
                object: object as u8,
                side: side.expect("a side"),
                relative_angle: held.angle - holder.angle,
            }
        });
    }
    state
}

/// Real agents turned left whichever way they wanted to turn.
fn left_only(action: Action) -> Action {
    if action == Action::TurnRight { Action::TurnLeft } else { action }
}
