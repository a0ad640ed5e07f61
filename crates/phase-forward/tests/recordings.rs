//! Long runs of the published simulator, and real recordings whose actions are known.

mod reference;

use phase_forward::Forward;
use phase_model::{Dynamics, Segment, State};
use reference::{action, body, distance, hold, inside, number, numbers, percentile, physique, read, set_up, state, walls};
use serde_json::Value;

/// Steps ahead at which predictions are compared.
const HORIZONS: [usize; 2] = [1, 10];

#[test]
fn predictions_from_recorded_states_hold() {
    let Some(file) = read("reference/runs.json") else { return };
    for horizon in HORIZONS {
        let (mut cold, mut warm, mut carried) = (Vec::new(), Vec::new(), Vec::new());
        for run in file["runs"].as_array().unwrap() {
            let forward = Forward::new(&physique(walls(&run["walls"]), &numbers(&run["radii"]), &numbers(&run["max_force"])));
            let actions = |step: usize| [0, 1].map(|agent| action(&run["actions"][agent][step]));
            let steps = run["states"].as_array().unwrap().len() - 1;
            let recorded: Vec<State> = recorded_states(run, steps);
            let mut all = Vec::new();
            for start in 1..=(steps - horizon) {
                let (mut a, mut b) = (recorded[start], recorded[start]);
                let mut memory = forward.remember(&b);
                let mut substeps = [b; 5];
                for step in start..start + horizon {
                    forward.step(&mut a, actions(step));
                    substeps = forward.step_warm(&mut b, &mut memory, actions(step));
                }
                assert_eq!(substeps[4], b);
                assert!(inside(&a) && inside(&b));
                cold.push(distance(&a, &recorded[start + horizon]));
                warm.push(distance(&b, &recorded[start + horizon]));
                all.push(cold[cold.len() - 1]);
            }
            if horizon == 1 {
                let bad: Vec<_> = all.iter().enumerate().filter(|e| *e.1 > 0.01).map(|(k, e)| format!("{}:{e:.3}", k + 1)).collect();
                println!("{} {bad:?}", run["name"]);
                // With memory from the very start, put back onto the recorded state at every step.
                let (mut now, mut memory) = set_up(&forward, recorded[0]);
                for step in 0..steps {
                    forward.step_warm(&mut now, &mut memory, actions(step));
                    if step > 0 { carried.push(distance(&now, &recorded[step + 1])); }
                    let grips = now.grips;
                    now = recorded[step + 1];
                    for agent in 0..2 { if now.grips[agent].is_some() { now.grips[agent] = grips[agent].or(now.grips[agent]); } }
                }
            }
        }
        for (name, mut errors) in [("from a state alone", cold), ("with fresh memory", warm), ("with true memory", carried)] {
            println!(
                "{horizon} steps ahead {name}: {} cases, p50 {:.6} p90 {:.6} p99 {:.6}",
                errors.len(), percentile(&mut errors, 50), percentile(&mut errors, 90), percentile(&mut errors, 99)
            );
        }
    }
}

/// The states of a run with the grips that go with them.
fn recorded_states(run: &Value, steps: usize) -> Vec<State> {
    (0..=steps)
        .map(|step| {
            let mut state = state(&run["states"][step]);
            if step > 0 {
                let held = &run["attached_after_step"][step - 1];
                let angles = [0, 1].map(|agent| {
                    held[agent].as_u64().map_or(0.0, |object| {
                        state.bodies[2 + object as usize].angle - state.bodies[agent].angle
                    })
                });
                hold(&mut state, held, angles);
            }
            state
        })
        .collect()
}

#[test]
fn real_recordings_are_replayed() {
    let Some(file) = read("real-phase/dev.json") else { return };
    let (mut close, mut all) = (0, 0);
    for event in file["events"].as_array().unwrap() {
        let Some(steps) = event["recovered_actions"]["steps"].as_array() else { continue };
        let radii: Vec<f32> = [&event["agents"], &event["objects"]]
            .into_iter()
            .flat_map(|list| list.as_array().unwrap().iter().map(|entity| number(&entity["radius"])))
            .collect();
        let forces: Vec<f32> = event["agents"].as_array().unwrap().iter().map(|agent| number(&agent["max_force"])).collect();
        let inner: Vec<Segment> = walls(&event["walls"]);
        let forward = Forward::new(&physique(inner, &radii, &forces));
        let row = |step: usize| {
            let entity = |kind: &str, k: usize| body(&event["trajectory"][kind][k][step]);
            State::new([entity("agents", 0), entity("agents", 1), entity("objects", 0), entity("objects", 1)])
        };
        let (mut now, mut memory) = set_up(&forward, row(0));
        let mut worst = 0.0_f32;
        let mut first = None;
        for (step, both) in steps.iter().enumerate() {
            let actions = [0, 1].map(|agent| left_only(action(&both[agent])));
            let substeps = forward.step_warm(&mut now, &mut memory, actions);
            let mut mean = substeps[0];
            for (entity, body) in mean.bodies.iter_mut().enumerate() {
                body.position = substeps.iter().map(|state| state.bodies[entity].position).sum::<phase_model::Vec2>() / 5.0;
            }
            let error = distance(&mean, &row(step + 1));
            worst = worst.max(error);
            if error > 0.02 && first.is_none() { first = Some((step, error, both.clone())); }
            all += 1;
            close += usize::from(error <= 0.02);
        }
        println!("{}: {} steps, worst {worst:.5} {first:?}", event["id"], steps.len());
    }
    println!("{close} of {all} steps within 0.02 u");
}

/// Real agents turned left whichever way they wanted to turn.
fn left_only(action: phase_model::Action) -> phase_model::Action {
    if action == phase_model::Action::TurnRight { phase_model::Action::TurnLeft } else { action }
}
