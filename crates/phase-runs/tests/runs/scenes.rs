//! Scenes as presets have them.

use phase_model::Layout;
use phase_runs::gen_dataset::{any_scene, plan};
use std::collections::BTreeSet;

#[test]
fn scenes_of_every_preset_are_valid_and_on_its_layouts() {
    for (name, _) in phase_data::PRESETS {
        let preset = plan::preset(name).expect("a bundled preset");
        let layouts: Vec<Layout> = preset.layouts.keys().flat_map(|pool| preset.pool(pool)).collect();
        let mut kinds = BTreeSet::new();
        for seed in 0..12 {
            let Ok(scene) = any_scene(&preset, seed) else { continue };
            assert_eq!(scene.validate(), Ok(()), "{name}, seed {seed}");
            assert!(layouts.contains(&scene.layout), "{name}, seed {seed}: {:?}", scene.layout);
            assert_eq!(any_scene(&preset, seed).expect("again"), scene, "{name}: a seed is a scene");
            kinds.insert(scene.kind);
            let unaware = scene.agents.iter().filter(|agent| agent.awareness.knows.level().is_some()).count();
            assert_eq!(unaware, if name == "phase-minds" { 2 } else { 0 }, "{name}, seed {seed}");
        }
        // Sets about beliefs are of one kind.
        let wanted = if name.starts_with("phase-beliefs") { 1 } else { 2 };
        assert!(kinds.len() >= wanted, "{name} has scenes of several kinds: {kinds:?}");
    }
}
