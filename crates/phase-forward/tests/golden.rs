//! The results of the kernel are pinned bit for bit: exact, warm-started, and coarse.

use phase_forward::Forward;
use phase_golden::{Digest, Golden, fixtures};
use phase_model::Dynamics;

#[test]
fn golden_runs_are_unchanged() -> Result<(), String> {
    let mut golden = Golden::new(env!("CARGO_MANIFEST_DIR"), "kernel");
    for (k, (physics, initial)) in fixtures::scenes().iter().enumerate() {
        let forward = Forward::new(physics);
        let actions = fixtures::actions(k as u64);

        let (mut state, mut digest) = (*initial, Digest::new());
        for &both in &actions {
            forward.step(&mut state, both);
            digest.state(physics, &state);
        }
        golden.add(format!("scene-{k}-exact"), digest.hex());

        let (mut state, mut digest) = (*initial, Digest::new());
        let mut solver_cache = forward.fresh_cache(&state);
        let mut held = 0;
        for &both in &actions {
            for substep in forward.step_warm(&mut state, &mut solver_cache, both) {
                digest.state(physics, &substep);
            }
            held += usize::from(state.grips.iter().any(Option::is_some));
        }
        assert!(
            physics.object_count == 0 || held > 10,
            "scene {k} has something in hand in {held} steps only"
        );
        golden.add(format!("scene-{k}-memory"), digest.hex());

        let (mut state, mut digest) = (*initial, Digest::new());
        for &both in &actions {
            forward.step_approximate(&mut state, both);
            digest.state(physics, &state);
        }
        golden.add(format!("scene-{k}-coarse"), digest.hex());
    }
    golden.check()
}
