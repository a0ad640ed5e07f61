//! Records of slots, and shards.

use crate::support::plain_event;
use phase_dataset::{
    acceptance::{Refusal, Tally},
    manifest::{DIGEST_FILE, EventEntry, MANIFEST_FILE, Manifest, event_path},
    manifest_writer::write_manifest,
    overview::Overview,
    preset::slot_id,
    shard::{DatasetDescription, Shard, slots, write_slots},
    slot_record::{Records, SlotRecord},
};
use phase_evidence::selection::RejectionReason;
use phase_files::{FileError, Problem, checksum::FileEntry};
use phase_sampler::Variant;
use std::{fs, path::Path};

#[test]
fn a_record_of_another_program_or_a_damaged_one_counts_for_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("slot.json");
    let empty = SlotRecord { fingerprint: "a".into(), ..SlotRecord::default() };
    assert_eq!(SlotRecord::load(&path, "a"), empty, "there is none yet");
    let refused = [RejectionReason::GoalMissed, RejectionReason::NoEffect];
    let refused = refused.map(|reason| Refusal { variant: Variant::Lift, reason }).to_vec();
    let record = SlotRecord { refused, ..empty.clone() };
    record.save(&path).expect("written");
    assert_eq!(SlotRecord::load(&path, "a"), record);
    assert_eq!(SlotRecord::load(&path, "b").refused, []);
    let text = fs::read_to_string(&path).expect("text");
    assert!(text.contains("goal-missed"), "{text}");
    for damaged in [&text[..text.len() / 2], "", "rubbish", &text.replace("no-effect", "no-idea")] {
        fs::write(&path, damaged).expect("written");
        assert_eq!(SlotRecord::load(&path, "a"), empty, "{damaged}");
    }
}

#[test]
fn attempts_are_counted_by_variant() {
    let mut tally = Tally::default();
    let refused = [RejectionReason::NoFlight, RejectionReason::NoEffect, RejectionReason::NoFlight]
        .map(|reason| Refusal { variant: Variant::Chase, reason });
    tally.add([Variant::Chase], &refused);
    tally.add([Variant::Lift], &[]);
    tally.add([Variant::Chase], &[]);
    let rows = tally.rows();
    assert_eq!(rows.iter().map(|row| row.variant).collect::<Vec<_>>(), [Variant::Lift, Variant::Chase]);
    assert_eq!((rows[1].events, rows[1].attempts), (2, 5));
    let reasons: Vec<(RejectionReason, usize)> =
        rows[1].refused.iter().map(|(&reason, &count)| (reason, count)).collect();
    assert_eq!(reasons.len(), 2);
    assert!(
        reasons.contains(&(RejectionReason::NoFlight, 2))
            && reasons.contains(&(RejectionReason::NoEffect, 1))
    );
}

#[test]
fn shards_share_the_slots_out() {
    for (events, of) in [(10, 3), (2, 5), (7, 1)] {
        let mut all: Vec<usize> = (1..=of).flat_map(|shard| slots(shard, of, events)).collect();
        all.sort_unstable();
        assert_eq!(all, (0..events).collect::<Vec<_>>());
    }
    assert_eq!(slots(3, 4, 12).collect::<Vec<_>>(), [2, 6, 10]);
}

fn whole() -> DatasetDescription {
    let text = r#"{"preset": "p", "events": 5, "slots": 5, "seed": 1, "generator": "g", "settings": {}, "selected": true, "videos": true, "date_published": null, "command": "c"}"#;
    serde_json::from_str(text).expect("a description")
}

/// Some records, in memory.
struct Listed(Vec<SlotRecord>);

impl Records for Listed {
    fn records(&self) -> Box<dyn Iterator<Item = Result<SlotRecord, FileError>> + '_> {
        Box::new(self.0.iter().cloned().map(Ok))
    }
}

/// Records of as many slots of the first of two shards, each with one event.
fn filled(folder: &Path, count: usize) -> Listed {
    let entry = |k: usize| EventEntry::of(folder, &slot_id("p", 2 * k), &plain_event(1), false);
    let record = |k: usize| {
        fs::create_dir_all(folder.join("events")).expect("a folder");
        fs::write(folder.join(event_path(&slot_id("p", 2 * k))), "an event").expect("written");
        let entries = vec![entry(k).expect("described")];
        SlotRecord { fingerprint: "a".into(), entries, ..SlotRecord::default() }
    };
    Listed((0..count).map(record).collect())
}

/// Writes the first of two shards, which has three of five slots.
fn first_shard(folder: &Path, records: &Listed) -> Shard {
    let slots = write_slots(folder, records).expect("written");
    let shard = Shard::of_records((1, 2), whole(), "a".into(), slots);
    shard.write(folder).expect("written");
    shard
}

#[test]
fn a_shard_is_read_slot_by_slot() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let records = filled(path, 3);
    let shard = first_shard(path, &records);
    assert_eq!(Shard::read(path).expect("a shard"), shard);
    let read: Vec<SlotRecord> = shard.records(path).map(|record| record.expect("a record")).collect();
    assert_eq!(read, records.0);
}

#[test]
fn what_is_no_shard_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let header = first_shard(path, &filled(path, 3));
    let text = serde_json::to_string(&header).expect("JSON");
    let cases = [
        (text.replace("\"shard\":1", "\"shard\":3"), "no shard 3 of 2"),
        (text.replace("\"shard\":1", "\"shard\":0"), "no shard 0 of 2"),
        (text.replace("shard/3", "shard/7"), "format"),
        (text[..60].to_owned(), "truncated"),
        (text.replace("preset", "recipe"), "recipe"),
        (text.replace("\"slots\":5", "\"slots\":9000000000000000000"), "must be 1 to 1000000"),
    ];
    for (text, part) in cases {
        fs::write(path.join("shard.json"), text).expect("written");
        let sentence = Shard::read(path).expect_err(part).to_string();
        assert!(sentence.contains("shard.json: ") && sentence.contains(part), "{sentence}");
    }
    header.write(path).expect("written");
    fs::write(path.join("slots.jsonl"), "another").expect("written");
    let sentence = Shard::read(path).expect_err("other records").to_string();
    assert!(sentence.contains("slots.jsonl: differs"), "{sentence}");
}

#[test]
fn a_shard_whose_slots_are_not_its_own_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let records = filled(path, 3);
    let empty = SlotRecord { fingerprint: "a".into(), ..SlotRecord::default() };
    let foreign = SlotRecord { fingerprint: "b".into(), ..records.0[1].clone() };
    let [first, second, third] = <[SlotRecord; 3]>::try_from(records.0).expect("three");
    let entry = second.entries[0].clone();
    let with = |entry: EventEntry| SlotRecord { entries: vec![entry], ..second.clone() };
    let other_id = with(EventEntry { id: "p-0004".into(), ..entry.clone() });
    let other_file = with(EventEntry { event: third.entries[0].event.clone(), ..entry.clone() });
    let other_video = with(EventEntry { video: Some(entry.event.clone()), ..entry.clone() });
    let two = SlotRecord { entries: vec![entry.clone(), entry], ..second.clone() };
    for record in [other_id, other_file, other_video, two, third.clone()] {
        let shard = first_shard(path, &Listed(vec![first.clone(), record, third.clone()]));
        let sentence = shard.records(path).find_map(Result::err).expect("another name").to_string();
        assert!(
            sentence.contains("the slot p-0002 has an event, a set or a file of another name"),
            "{sentence}"
        );
    }
    for (records, rule) in [
        (vec![first.clone(), second.clone()], "the records of 1 slots are missing"),
        (vec![first.clone(), empty, second], "holds no event"),
        (vec![first.clone(), foreign, first], "another program"),
    ] {
        let shard = first_shard(path, &Listed(records));
        let error = shard.records(path).find_map(Result::err).expect(rule);
        let sentence = error.to_string();
        assert!(sentence.contains("slots.jsonl: ") && sentence.contains(rule), "{sentence}");
        assert!(shard.records(path).count() <= 3, "nothing is read after an error");
    }
}

/// A manifest that was written event by event is the one that is written as a whole.
#[test]
fn manifests_do_not_depend_on_how_they_are_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let records = filled(path, 3);
    for selection in [Vec::new(), Tally::default().rows()] {
        let mut overview = Overview::new(&whole());
        records.0.iter().flat_map(|record| &record.entries).for_each(|entry| overview.count(entry));
        overview.selection = selection;
        overview.files = vec![FileEntry::of(path, event_path(&slot_id("p", 2))).expect("there")];
        let bytes = || [MANIFEST_FILE, DIGEST_FILE].map(|name| fs::read(path.join(name)).expect("bytes"));
        let digest = write_manifest(path, &overview, &records).expect("written");
        assert_eq!(digest, FileEntry::of(path, MANIFEST_FILE).expect("there").sha256);
        let manifest = Manifest::read(&path.join(MANIFEST_FILE)).expect("a manifest");
        assert_eq!(manifest.events.len(), 3);
        assert_eq!(Overview::of(&manifest), overview);
        let streamed = bytes();
        assert_eq!(String::from_utf8_lossy(&streamed[1]), format!("{digest}  manifest.json\n"));
        manifest.write(path).expect("written");
        assert_eq!(streamed, bytes());
    }
}

#[test]
fn a_manifest_is_not_written_if_a_record_is_missing() {
    struct Broken(fn() -> FileError);
    impl Records for Broken {
        fn records(&self) -> Box<dyn Iterator<Item = Result<SlotRecord, FileError>> + '_> {
            Box::new(core::iter::once(Err(self.0())))
        }
    }
    let folder = tempfile::tempdir().expect("a folder");
    let missing = || FileError { file: "slot.json".into(), problem: Problem::IsFolder };
    let error =
        write_manifest(folder.path(), &Overview::new(&whole()), &Broken(missing)).expect_err("no record");
    assert!(error.to_string().contains("slot.json"), "{error}");
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
}
