//! Datasets whose events share their bodies.

use crate::support::{succeed, tree};
use phase_dataset::manifest::{EventEntry, Manifest};
use phase_evidence::Manner;
use phase_sampler::Variant;
use std::fs;

/// Two blocks of three events.
const PRESET: &str = r#"{
  "format": "phase-preset/3", "name": "blocks", "seed": 8,
  "layouts": {"some": [0, 2, 6]},
  "selection": {"min_steps": 40, "max_steps": 60, "attempts": 400, "ends": "drawn"},
  "blocks": {
    "columns": [["drag"], ["chase", "places"], ["mixed"]],
    "groups": [{"split": "train", "layouts": "some", "blocks": 2}]
  }
}"#;

fn generate<'a>(out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let options = ["gen-dataset", "--preset", "blocks.json", "--simulations", "20", "--particles", "4"];
    [&options[..], &["--no-video", "--out", out], more].concat()
}

/// What is seen before anything moves, apart from directions and the objects' numbers.
fn bodies(event: &EventEntry) -> ([u8; 2], Vec<u8>, (u8, Option<u8>)) {
    let mut objects = event.object_size_levels.clone();
    objects.sort_unstable();
    (event.agents.map(|agent| agent.size_level), objects, (event.layout.base, event.layout.flip))
}

#[test]
fn events_of_a_block_share_bodies_whatever_the_shards() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    fs::write(path.join("blocks.json"), PRESET).expect("written");
    succeed(path, &generate("whole", &[]));
    succeed(path, &["verify", "whole", "--replay", "--preset", "blocks.json", "--resimulate", "2"]);
    for shard in ["1/2", "2/2"] {
        succeed(path, &generate(&format!("shard{}", &shard[..1]), &["--shard", shard]));
    }
    succeed(path, &["merge", "shard1", "shard2", "--out", "merged"]);
    assert!(tree(&path.join("merged")) == tree(&path.join("whole")), "merged shards differ from one run");

    let manifest = Manifest::read(&path.join("whole/manifest.json")).expect("a manifest");
    let variants: Vec<Variant> = manifest.events.iter().filter_map(|event| event.variant).collect();
    assert_eq!(
        variants,
        [Variant::Drag, Variant::Chase, Variant::Mixed, Variant::Drag, Variant::Places, Variant::Mixed]
    );
    for block in manifest.events.chunks(3) {
        for event in block {
            assert_eq!(event.object_size_levels.len(), 2);
            assert!((40..=60).contains(&event.steps), "{}", event.steps);
        }
    }
    for event in manifest.events.iter().filter(|event| event.variant == Some(Variant::Drag)) {
        assert!(event.manners.contains(&Manner::Dragging), "{event:?}");
    }
    // A slot moves on to its block's next stage after three rejections, so not all do.
    let shared = manifest.events.chunks(3).filter(|block| bodies(&block[0]) == bodies(&block[2])).count();
    assert!(shared > 0, "no block shares its bodies");

    // The settings of an event reproduce it.
    let event = &manifest.events[0];
    let file = format!("whole/{}", event.event.path);
    let text = fs::read_to_string(path.join(&file)).expect("text");
    let value: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let settings = &value["events"][0]["settings"];
    for length in ["min_steps", "max_steps"] {
        assert_eq!(settings[length], event.steps, "{settings}");
    }
}
