//! Files of the importer in `data/` can be read here.

use phase_dataset::phase_events::read;
use phase_model::EventKind;
use std::process::Command;

#[test]
fn what_the_importer_writes_is_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("events.json");
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/import_pik.py");
    let Ok(output) = Command::new("python3").args([script, "--self-test", "--out"]).arg(&file).output()
    else {
        eprintln!("skipped: there is no python3");
        return;
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let recordings = read(&file).expect("phase-events/1");
    assert_eq!(recordings.len(), 9);
    for recording in recordings {
        assert_eq!(recording.scene.kind, EventKind::Helping, "{}", recording.id);
        assert_eq!(recording.trajectory.steps(), 6, "{}", recording.id);
        // Raw records contain actions, reflected ones do not.
        assert_eq!(recording.recovered_actions.is_some(), recording.id.ends_with("raw"), "{}", recording.id);
    }
}
