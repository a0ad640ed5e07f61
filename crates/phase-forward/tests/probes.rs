//! The published simulator's probes, replayed from their starts.

mod reference;

use phase_forward::Forward;
use phase_model::Vec2;
use reference::{action, distance, number, numbers, percentile, physique, read, set_up, state, walls};
use serde_json::Value;
use std::collections::BTreeMap;

/// The families of probes by the start of their names, with the position errors (u) that nine in ten substeps
/// stay under: with memory, and step by step without.
const FAMILIES: [(&str, f32, f32); 16] = [
    ("free_action", 1e-5, 1e-5),
    ("free", 1e-5, 1e-5),
    ("stop", 1e-5, 1e-5),
    ("coast", 1e-5, 1e-5),
    ("item_coast", 1e-5, 1e-5),
    ("turn", 1e-5, 1e-5),
    ("wall", 1e-3, 1e-3),
    ("inner_wall", 1e-5, 1e-5),
    ("push", 1e-4, 1e-3),
    ("grab_pull", 1e-5, 5e-3),
    ("grab_turn", 1e-4, 1e-4),
    ("attach", 1e-5, 2e-3),
    ("carry", 1e-3, 5e-3),
    ("tug", 1e-5, 1e-5),
    ("items_collide", 1e-3, 1e-2),
    ("collide", 1e-3, 1e-3),
];
/// The greatest error of any substep with memory (u).
const WORST: f32 = 0.005;

#[test]
fn probes_are_replayed() {
    let Some(file) = read("reference/probes.json") else { return };
    let mut errors: BTreeMap<&str, (Vec<f32>, Vec<f32>)> = BTreeMap::new();
    for probe in file["probes"].as_array().expect("a list") {
        let name = probe["name"].as_str().unwrap();
        let family = FAMILIES.into_iter().find(|(family, ..)| name.starts_with(family)).unwrap().0;
        let (warm, cold) = errors.entry(family).or_default();
        let errors = replay(probe);
        warm.extend(errors.0);
        cold.extend(errors.1);
    }
    for (family, warm_limit, cold_limit) in FAMILIES {
        let (warm, cold) = errors.get_mut(family).unwrap();
        let rows = warm.len();
        let [warm, cold] = [warm, cold].map(|errors| [50, 90, 100].map(|p| percentile(errors, p)));
        println!("{family:<14} {rows:>5} substeps, p50 p90 max: {warm:.6?} with memory, {cold:.6?} without");
        assert!(warm[1] < warm_limit && cold[1] < cold_limit && warm[2] < WORST, "{family}");
    }
}

/// Position errors of all substeps: with memory, and step by step without.
fn replay(probe: &Value) -> (Vec<f32>, Vec<f32>) {
    let forward = Forward::new(&physique(
        walls(&probe["wall_segs"]),
        &numbers(&probe["sizes"]),
        &probe["max_force"].as_array().expect("a list").iter().map(number).collect::<Vec<_>>(),
    ));
    let recorded = |k: usize| {
        let rows = probe["substeps"].as_array().expect("a list");
        state(&Value::Array(rows.iter().map(|entity| entity[k].clone()).collect()))
    };
    let (mut warm, mut memory) = set_up(&forward, recorded(0));
    let mut cold = recorded(0);
    forward.settle(&mut cold);
    for (body, velocity) in probe["init_velocities"].as_array().into_iter().flatten().enumerate() {
        if let Some(velocity) = velocity.as_array() {
            for state in [&mut warm, &mut cold] {
                state.bodies[body].velocity = Vec2::new(number(&velocity[0]), number(&velocity[1]));
            }
        }
    }
    let mut errors = (Vec::new(), Vec::new());
    for step in 0..probe["steps"].as_array().expect("a list").len() {
        let actions = [0, 1].map(|agent| action(&probe["actions"][agent][step]));
        let warm_substeps = forward.step_warm(&mut warm, &mut memory, actions);
        let cold_substeps = forward.step_substeps(&mut cold, actions);
        for k in 0..5 {
            let recorded = recorded(1 + 5 * step + k);
            errors.0.push(distance(&warm_substeps[k], &recorded));
            errors.1.push(distance(&cold_substeps[k], &recorded));
        }
        let held = [0, 1].map(|agent| warm.held_object(agent).map(|object| object as u64));
        let recorded = &probe["attached_after_step"][step];
        assert_eq!(held, [recorded[0].as_u64(), recorded[1].as_u64()], "{} step {step}", probe["name"]);
    }
    errors
}
