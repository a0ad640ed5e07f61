//! Every target, shortly: on its seeds, on inputs that once failed, and on mutations of both. `cargo xtask
//! fuzz` runs them for longer.

use phase_calibration::{Probe, Run};
use phase_dataset::{
    manifest::Manifest,
    preset::Preset,
    shard::{SHARD_FILE, SLOTS_FILE, Shard},
    slot_record::SlotRecord,
};
use phase_eval::{predictions, ratings};
use phase_fuzz::{fuzzing, seeds::seeds, targets};
use phase_game::{FromPlayer, journal};
use phase_model::{
    Scene,
    json::{self, Field},
    path::RelativePath,
};
use phase_sim::SimulationSettings;
use phase_simple::ReportModel;
use phase_study::{
    config::StudyConfig,
    export::participants,
    forms::{Form, Forms},
    question::Responses,
};
use phase_track::TableOptions;
use std::{cell::Cell, fs, path::Path};

/// Mutations of each target.
const MUTATIONS: u32 = 60;

/// The inputs kept in `corpus/<target>`: some that once failed, small files that were made by commands, and
/// some that fuzzing guided by coverage found.
fn corpus(target: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target);
    let Ok(files) = fs::read_dir(folder) else { return Vec::new() };
    files.map(|file| fs::read(file.expect("an entry").path()).expect("an input")).collect()
}

#[test]
fn no_target_fails() {
    for target in targets::TARGETS {
        let left = Cell::new(MUTATIONS);
        let goes_on = || {
            left.set(left.get().saturating_sub(1));
            left.get() > 0
        };
        let executions = fuzzing::run(target, corpus(target.0), 1, goes_on);
        let executions = executions.unwrap_or_else(|failure| panic!("{}: {}", target.0, failure.message));
        assert!(executions >= u64::from(MUTATIONS), "{}", target.0);
    }
}

#[test]
fn failures_are_found() {
    let input = vec![b'a'; 8];
    let failure = fuzzing::run(
        ("paths", |data| assert!(data.iter().all(u8::is_ascii), "not ASCII")),
        vec![input],
        1,
        || true,
    );
    let failure = failure.expect_err("mutations have other bytes");
    assert_eq!(failure.message, "not ASCII");
    assert!(!failure.input.is_ascii());
}

/// Readers accept the seeds, so that mutations reach what comes after the first check.
#[test]
fn seeds_are_accepted() {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("a text");
    type Accepts<'a> = (&'a str, &'a dyn Fn(&[u8]) -> bool);
    let forms = Forms::read(phase_data::FORMS).expect("forms");
    let readers: [Accepts<'_>; 15] = [
        ("events", &|seed| phase_event::parse(seed).is_ok()),
        ("table", &|seed| phase_track::table(seed, "csv", &TableOptions::default()).is_ok()),
        ("scene", &|seed| Scene::from_json(&text(seed)).is_ok()),
        ("preset", &|seed| Preset::parse("seed.json", &text(seed)).is_ok()),
        ("paths", &|seed| RelativePath::new(text(seed)).is_ok()),
        ("settings", &|seed| serde_json::from_slice::<SimulationSettings>(seed).is_ok()),
        ("predictions", &|seed| {
            let value = json::parse(seed).expect("JSON");
            predictions::goals(&value).is_ok() || predictions::forecasts(&value).is_ok()
        }),
        ("ratings", &|seed| ratings::ratings(&json::parse(seed).expect("JSON")).is_ok()),
        ("jspsych", &|seed| participants(&text(seed)).is_ok()),
        ("answers", &|seed| {
            let value = json::parse(seed).expect("JSON");
            let is_of = |form| Responses::read(&Field::root(&value), &forms.questions(form, 2)).is_ok();
            Form::ALL.into_iter().any(is_of)
        }),
        ("journal", &|seed| journal::entries(&text(seed)).is_ok()),
        ("message", &|seed| FromPlayer::parse(&text(seed)).is_ok()),
        ("study", &|seed| StudyConfig::read(seed, &forms).is_ok()),
        ("forms", &|seed| Forms::read(&text(seed)).is_ok()),
        ("report_model", &|seed| ReportModel::from_json(&text(seed)).is_ok()),
    ];
    let refused: Vec<&str> = readers
        .iter()
        .filter(|(name, accepts)| seeds(name).is_empty() || !seeds(name).iter().all(|seed| accepts(seed)))
        .map(|(name, _)| *name)
        .collect();
    assert_eq!(refused, [""; 0]);
}

/// Files that commands have made are accepted, for targets whose seeds cannot be written by hand.
#[test]
fn kept_files_are_accepted() {
    let kept = |target: &str, name: &str| {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target).join(name)
    };
    let text = |path: &Path| fs::read_to_string(path).expect("a kept file");
    Manifest::read(&kept("manifest", "tiny")).expect("a manifest");
    let record = SlotRecord::load(&kept("records", "slot-of-fuzz"), "fuzz");
    assert!(record.is_filled());
    assert_eq!(Probe::parse(&text(&kept("calibration", "probe"))).expect("probes").len(), 1);
    assert_eq!(Run::parse(&text(&kept("calibration", "run"))).expect("runs").len(), 1);
    // Its records have to be beside it, and the file is one of three.
    let folder = tempfile::tempdir().expect("a folder");
    for (name, file) in [("shard", SHARD_FILE), ("slot", SLOTS_FILE)] {
        fs::copy(kept("records", name), folder.path().join(file)).expect("copied");
    }
    Shard::read(folder.path()).expect("a shard");
}
