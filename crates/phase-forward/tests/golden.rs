//! The results of the kernel are pinned bit for bit: exact, warm-started, and coarse.

use phase_forward::{Exertion, Forward};
use phase_golden::{Digest, Golden, fixtures};
use phase_model::{Dynamics, arena::SUBSTEPS};

/// Worlds in lanes.
const WORLDS: usize = 8;

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
        let memory = digest.hex();
        golden.add(format!("scene-{k}-memory"), memory.clone());

        let mut digests = [(); WORLDS].map(|()| Digest::new());
        let (mut states, mut caches) = ([*initial; WORLDS], [forward.fresh_cache(initial); WORLDS]);
        let mut substeps = [[*initial; SUBSTEPS]; WORLDS];
        for &actions in &actions {
            let exertion =
                Exertion { actions, max_forces: physics.agents.each_ref().map(|agent| agent.max_force) };
            forward.step_warm_batch(&mut states, &mut caches, &[exertion; WORLDS], &mut substeps);
            for (digest, substeps) in digests.iter_mut().zip(&substeps) {
                substeps.iter().for_each(|substep| digest.state(physics, substep));
            }
        }
        for lane in digests {
            assert_eq!(lane.hex(), memory, "scene {k} in lanes");
        }

        let (mut state, mut digest) = (*initial, Digest::new());
        for &both in &actions {
            forward.step_approximate(&mut state, both);
            digest.state(physics, &state);
        }
        golden.add(format!("scene-{k}-coarse"), digest.hex());
    }
    golden.check()
}
