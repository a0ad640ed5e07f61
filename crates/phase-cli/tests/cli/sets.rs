//! Datasets of sets that differ in one social variable.

use crate::support::{refuse, run, succeed, text, tree};
use phase_dataset::{
    event_set::SetPlace,
    manifest::{EventEntry, Manifest},
    phase_events,
};
use phase_sampler::Stance;
use serde_json::Value;
use std::{collections::BTreeSet, fs, path::Path};

const PRESET: &str = r#"{
  "format": "phase-preset/3", "name": "sets", "seed": 5,
  "layouts": {"some": [0, 2, 6]},
  "selection": {"min_steps": 40, "max_steps": 50, "attempts": 400, "ends": "drawn"},
  "sets": [
    {"stances": ["hinder", "indifferent"], "about": "place", "split": "test", "layouts": "some", "sets": 2}
  ]
}"#;

fn generate<'a>(out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let options = ["gen-dataset", "--preset", "sets.json", "--simulations", "20", "--particles", "4"];
    [&options[..], &["--out", out], more].concat()
}

fn manifest(path: &Path) -> Manifest {
    Manifest::read(&path.join("manifest.json")).expect("a manifest")
}

#[test]
fn sets_are_whole_whatever_the_shards() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    fs::write(path.join("sets.json"), PRESET).expect("written");
    succeed(path, &generate("whole", &[]));
    for shard in ["1/2", "2/2"] {
        succeed(path, &generate(&format!("shard{}", &shard[..1]), &["--shard", shard]));
    }
    succeed(path, &["merge", "shard1", "shard2", "--out", "merged"]);
    assert!(tree(&path.join("merged")) == tree(&path.join("whole")), "merged shards differ from one run");
    succeed(path, &["verify", "whole", "--replay", "--preset", "sets.json", "--resimulate", "1"]);

    let manifest = manifest(&path.join("whole"));
    assert_eq!((manifest.events.len(), manifest.sets.len()), (4, 2));
    for set in &manifest.sets {
        let members: Vec<&EventEntry> =
            manifest.events.iter().filter(|event| event.id.starts_with(&set.id)).collect();
        let stances: BTreeSet<Stance> =
            members.iter().filter_map(|event| Some(event.set.as_ref()?.stance)).collect();
        assert_eq!(stances.len(), members.len());
        assert_eq!(set.pairs.len(), members.len() * (members.len() - 1) / 2);
        assert!(members.iter().all(|event| event.steps == members[0].steps && event.seed == members[0].seed));
        assert!(set.video.as_ref().expect("a video").place(&path.join("whole")).exists());
        // Where the manifest says that a pair parts, bodies are elsewhere, and before they are not.
        for pair in &set.pairs {
            let rows = pair.events.clone().map(|id| {
                let read =
                    phase_events::read(&path.join(format!("whole/events/{id}.json"))).expect("an event");
                let places =
                    |rows: &Vec<_>| rows.iter().map(|row: &[f32; 5]| [row[0], row[1]]).collect::<Vec<_>>();
                read[0].trajectory.entities().map(places).collect::<Vec<_>>()
            });
            let first = pair.first.expect("they part");
            for (one, other) in rows[0].iter().zip(&rows[1]) {
                assert_eq!(one[..first], other[..first]);
            }
        }
    }
    let table = fs::read_to_string(path.join("whole/pairs.csv")).expect("a table");
    let lengths: BTreeSet<usize> = table.lines().map(|line| line.split(',').count()).collect();
    assert_eq!((table.lines().count(), lengths.len()), (1 + 1 + 1, 1));
    let place = |set: &str| SetPlace { set: set.into(), stance: Stance::Hinder };
    assert!(
        manifest
            .events
            .iter()
            .any(|event| event.set == Some(place("sets-0000")) || event.set == Some(place("sets-0001")))
    );

    // Methods are scored by sets.
    succeed(path, &["eval", "goals", "--method", "chance", "--events", "whole", "--out", "scores"]);
    let results = fs::read_to_string(path.join("scores/results.json")).expect("results");
    let results: Value = serde_json::from_str(&results).expect("JSON");
    assert_eq!(results["sets"]["n"], 2);

    // A manifest that is wrong about a pair is found out.
    let whole = fs::read_to_string(path.join("whole/manifest.json")).expect("text");
    let mut value: Value = serde_json::from_str(&whole).expect("JSON");
    value["sets"][0]["pairs"][0]["first"] = 39.into();
    fs::write(path.join("whole/manifest.json"), value.to_string()).expect("written");
    let message = text(&run(path, &["verify", "whole"]).stderr);
    assert!(message.contains("`pairs` of the set"), "{message}");
}

#[test]
fn incomplete_and_impossible_sets_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    fs::write(path.join("sets.json"), PRESET).expect("written");
    let message = refuse(path, &generate("out", &["--events", "3"]));
    assert!(message.contains("--events 3") && message.contains("incomplete"), "{message}");
    for (from, to, part) in [
        (
            r#"["hinder", "indifferent"]"#,
            r#"["help", "hinder"]"#,
            "the stance help needs a goal about an object",
        ),
        (r#"["hinder", "indifferent"]"#, r#"["hinder"]"#, "two or more different stances"),
        (r#""ends": "drawn""#, r#""ends": "settled""#, "equally long"),
        (r#""sets": 2}"#, r#""sets": 0}"#, "`sets[0].sets` must be 1 to 1000000, not 0"),
    ] {
        fs::write(path.join("sets.json"), PRESET.replacen(from, to, 1)).expect("written");
        let message = refuse(path, &generate("out", &[]));
        assert!(message.contains(part), "{message}");
    }
}
