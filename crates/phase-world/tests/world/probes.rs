//! Recordings of the published simulator, replayed from their initial states, if they are at hand.

use phase_model::{Action, AgentBody, Body, Physique, Segment, State, Vec2};
use phase_world::World;
use serde::Deserialize;
use std::collections::BTreeMap;

#[derive(Deserialize)]
struct Recordings {
    probes: Vec<Probe>,
}

#[derive(Deserialize)]
struct Probe {
    name: String,
    wall_segs: Vec<[[f32; 2]; 2]>,
    sizes: [f32; 4],
    max_force: [f32; 2],
    actions: [Vec<Action>; 2],
    /// x, y, vx, vy, angle and angular velocity of each body.
    initial: [[f32; 6]; 4],
    steps: Vec<[[f32; 6]; 4]>,
    attached_after_step: Vec<[Option<usize>; 2]>,
}

/// Greatest position error (u) and angle error (rad) over the bodies after one step.
type StepError = (f32, f32);

fn body(row: &[f32; 6]) -> Body {
    Body {
        position: Vec2::new(row[0], row[1]),
        velocity: Vec2::new(row[2], row[3]),
        angle: row[4],
        angular_velocity: row[5],
    }
}

fn family(name: &str) -> &str {
    let families = [
        ("items_collide", "items_collide"),
        ("push_off", "push_off_centre"),
        ("item_coast", "coast"),
        ("attach", "grab"),
        ("inner_wall", "wall"),
        ("turn", "turn"),
    ];
    let special = families.into_iter().find(|(prefix, _)| name.starts_with(prefix));
    special.map_or_else(|| name.split('_').next().unwrap_or(name), |(_, family)| family)
}

fn replay(probe: &Probe) -> Vec<StepError> {
    let physique = Physique {
        walls: probe.wall_segs.iter().map(|&[a, b]| Segment { a: a.into(), b: b.into() }).collect(),
        agents: [0, 1].map(|k| AgentBody { radius: probe.sizes[k], max_force: probe.max_force[k] }),
        object_radii: [probe.sizes[2], probe.sizes[3]],
        object_count: 2,
    };
    let mut world = World::new(&physique, &State::new([0, 1, 2, 3].map(|k| body(&probe.initial[k]))));
    let step = |(step, expected): (usize, &[[f32; 6]; 4])| {
        let state = world.step([0, 1].map(|agent| probe.actions[agent][step]))[4];
        let held = [0, 1].map(|agent| state.held_object(agent));
        assert_eq!(held, probe.attached_after_step[step], "{}: grips after step {step}", probe.name);
        let errors = state.bodies.iter().zip(expected).map(|(got, want)| {
            let want = body(want);
            (got.position.distance(want.position), (got.angle - want.angle).abs())
        });
        errors.fold((0.0, 0.0), |worst: StepError, error| (worst.0.max(error.0), worst.1.max(error.1)))
    };
    probe.steps.iter().enumerate().map(step).collect()
}

fn quantile(errors: &[StepError], share: f32, of: impl Fn(&StepError) -> f32) -> f32 {
    let mut values: Vec<f32> = errors.iter().map(of).collect();
    values.sort_by(f32::total_cmp);
    values[((values.len() - 1) as f32 * share).round() as usize]
}

/// Share of steps within a limit in both position (u) and angle (rad).
fn within(errors: &[StepError], limit: f32) -> f32 {
    errors.iter().filter(|error| error.0 <= limit && error.1 <= limit).count() as f32 / errors.len() as f32
}

#[test]
fn recordings_are_reproduced() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/reference/probes.json");
    let Ok(text) = std::fs::read_to_string(path) else {
        println!("skipped: no recordings at hand");
        return;
    };
    let recordings: Recordings = serde_json::from_str(&text).expect("the recordings can be read");
    let mut families: BTreeMap<&str, Vec<StepError>> = BTreeMap::new();
    for probe in &recordings.probes {
        families.entry(family(&probe.name)).or_default().extend(replay(probe));
    }
    for (family, errors) in &families {
        let row = |of: fn(&StepError) -> f32| [0.5, 0.9, 1.0].map(|share| quantile(errors, share, of));
        println!(
            "{family:15} {:3} steps; p50 p90 max: {:.4?} u, {:.4?} rad; within 0.01: {:.3}, within 0.1: {:.3}",
            errors.len(),
            row(|error| error.0),
            row(|error| error.1),
            within(errors, 0.01),
            within(errors, 0.1),
        );
    }
    for family in ["free", "coast", "turn", "stop"] {
        assert!(within(&families[family], 0.01) >= 0.9, "{family}");
    }
    for family in ["wall", "push", "grab", "carry", "collide"] {
        assert!(within(&families[family], 0.1) >= 0.9, "{family}");
    }
    for family in ["tug", "push_off_centre"] {
        assert!(quantile(&families[family], 0.9, |error| error.0) <= 0.05, "{family}");
    }
}
