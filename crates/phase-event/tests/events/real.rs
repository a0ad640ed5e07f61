//! The published recordings, where they are available.

use phase_event::{EventWarning, from_json, to_json};
use phase_model::SceneWarning;
use std::{fs, path::Path};

#[test]
fn real_recordings_are_read_and_written_back() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/real-phase/dev.json");
    if !path.is_file() {
        println!("skipped: the real recordings are not at hand");
        return;
    }
    let recordings = from_json(&fs::read_to_string(&path).expect("a text")).expect("the real recordings");
    assert!(!recordings.is_empty());
    for recording in &recordings {
        assert_eq!(recording.relation, recording.scene.relation(), "{}", recording.id);
        assert!(recording.simulation.is_none());
        // Some of them begin with bodies that overlap each other or walls; there are no other warnings.
        let starts = |warning: &EventWarning| {
            use SceneWarning::{AcrossWall, Overlap};
            matches!(warning, EventWarning::Scene(Overlap { .. } | AcrossWall { .. }))
        };
        assert!(recording.warnings().iter().all(starts), "{}: {:?}", recording.id, recording.warnings());
    }
    let text = to_json(&recordings).expect("finite");
    assert_eq!(from_json(&text).expect("our own file"), recordings);
}
