//! The published simulator's probes, replayed from their starts.

mod reference;

use phase_forward::Forward;
use phase_model::Vec2;
use reference::{action, distance, number, numbers, percentile, physique, read, set_up, state, walls};
use serde_json::Value;
use std::collections::BTreeMap;

#[test]
fn probes_are_replayed() {
    let Some(file) = read("reference/probes.json") else { return };
    let mut errors: BTreeMap<&str, (Vec<f32>, Vec<f32>)> = BTreeMap::new();
    for probe in file["probes"].as_array().unwrap() {
        let name = probe["name"].as_str().unwrap();
        let (warm, cold) = errors.entry(family(name)).or_default();
        let (a, b) = replay(probe);
        let worst = a.iter().copied().fold(0.0, f32::max);
        if worst > 0.002 {
            println!("{name}: worst {worst:.5} first bad substep {:?}", a.iter().position(|e| *e > 0.001));
        }
        warm.extend(a);
        cold.extend(b);
    }
    println!("{:<16} {:>7} | warm: {:>9} {:>9} {:>9} | cold: {:>9} {:>9}", "family", "rows", "p50", "p90", "max", "p90", "max");
    for (family, (warm, cold)) in &mut errors {
        let rows = warm.len();
        let p90 = percentile(warm, 90);
        println!(
            "{family:<16} {rows:>7} | warm: {:>9.6} {p90:>9.6} {:>9.6} | cold: {:>9.6} {:>9.6}",
            percentile(warm, 50),
            percentile(warm, 100),
            percentile(cold, 90),
            percentile(cold, 100)
        );
    }
}

/// The kind of probe.
fn family(name: &str) -> &str {
    const FAMILIES: [&str; 15] = [
        "free_action", "free", "stop", "coast", "item_coast", "turn", "wall", "inner_wall", "push", "grab_pull",
        "grab_turn", "attach", "carry", "tug", "items_collide",
    ];
    FAMILIES.into_iter().find(|family| name.starts_with(family)).unwrap_or("collide")
}

/// Position errors of all substeps: with memory, and step by step without.
fn replay(probe: &Value) -> (Vec<f32>, Vec<f32>) {
    let forward = Forward::new(&physique(
        walls(&probe["wall_segs"]),
        &numbers(&probe["sizes"]),
        &probe["max_force"].as_array().unwrap().iter().map(number).collect::<Vec<_>>(),
    ));
    let recorded = |k: usize| {
        let rows = probe["substeps"].as_array().unwrap();
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
    for step in 0..probe["steps"].as_array().unwrap().len() {
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
