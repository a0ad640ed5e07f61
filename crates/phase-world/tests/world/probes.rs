//! Probes and runs of the published simulator, if they are available.

use phase_calibration::{Probe, Run, WorldEngine, horizon_errors, probes_report};

fn text(file: &str) -> Option<String> {
    let path = format!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/reference/{}"), file);
    let text = std::fs::read_to_string(path).ok();
    if text.is_none() {
        println!("skipped: no recordings at hand");
    }
    text
}

#[test]
fn probes_are_reproduced() {
    let Some(text) = text("probes.json") else { return };
    let report = probes_report::<WorldEngine>(&Probe::parse(&text).expect("good probes"));
    for (name, family) in &report.families {
        println!(
            "{name:15} {:3} steps; {:.4?} u, {:.4?} rad; within 0.01: {:.3}, within 0.1: {:.3}",
            family.steps, family.position, family.angle, family.within_0_01, family.within_0_1,
        );
        assert_eq!(family.grip_mismatches, 0, "{name}: grips");
    }
    for family in ["free", "coast", "turn", "stop"] {
        assert!(report.families[family].within_0_01 >= 0.9, "{family}");
    }
    for family in ["wall", "push", "grab", "carry", "collide"] {
        assert!(report.families[family].within_0_1 >= 0.9, "{family}");
    }
    for family in ["tug", "push_off_centre"] {
        assert!(report.families[family].position.p90 <= 0.05, "{family}");
    }
}

#[test]
fn one_step_ahead_the_world_is_near_the_record() {
    /// Bound on nine in ten steps (u).
    const P90: f32 = 0.03;
    /// Bound on 99 in 100 steps (u). The target is 0.25.
    const P99: f32 = 0.2;
    let Some(text) = text("runs.json") else { return };
    let runs = Run::parse(&text).expect("good runs");
    let one = horizon_errors::<WorldEngine>(&runs, 1).expect("runs that are long enough");
    println!("one step ahead: {one:.5?}; ten: {:.5?}", horizon_errors::<WorldEngine>(&runs, 10));
    assert!(one.p90 <= P90 && one.p99 <= P99);
}
