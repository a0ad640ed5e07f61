//! The results of the reference world are pinned bit for bit.

use phase_golden::{Digest, Golden, fixtures};
use phase_world::World;

#[test]
fn golden_runs_are_unchanged() -> Result<(), String> {
    let mut golden = Golden::new(env!("CARGO_MANIFEST_DIR"), "world");
    for (k, (physics, state)) in fixtures::scenes().iter().enumerate() {
        let mut world = World::new(physics, state);
        let mut digest = Digest::new();
        let mut contacts = 0;
        for actions in fixtures::actions(k as u64) {
            for substep in world.step(actions) {
                digest.state(physics, &substep);
                contacts += usize::from(substep.contacts != phase_model::Contacts::NONE);
            }
        }
        assert!(contacts > 100, "scene {k} has bodies in contact in {contacts} substeps only");
        golden.add(format!("scene-{k}"), digest.hex());
    }
    golden.check()
}
