//! Records of slots, and shards.

use phase_dataset::{
    acceptance::{Refusal, Tally},
    shard::{Shard, slots},
    slot_record::SlotRecord,
};
use phase_evidence::selection::RejectionReason;
use phase_sampler::Variant;
use std::fs;

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

#[test]
fn what_is_no_shard_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("shard.json");
    let whole = r#"{"preset": "p", "events": 4, "slots": 4, "seed": 1, "generator": "g", "settings": {}, "selected": true, "command": "c"}"#;
    let shard = |number: usize, slots: &str| {
        format!(
            r#"{{"format": "phase-shard/2", "shard": {number}, "of": 2, "whole": {whole}, "slots": {slots}}}"#
        )
    };
    let none = r#"[{"fingerprint": "", "refused": [], "entries": []}]"#;
    let cases = [
        (shard(3, "[]"), "no shard 3 of 2"),
        (shard(0, "[]"), "no shard 0 of 2"),
        (shard(1, none), "0 filled slots instead of 2"),
        (shard(1, "[]").replace("shard/2", "shard/7"), "format"),
        (shard(1, "[")[..60].to_owned(), "truncated"),
        (shard(1, "[]").replace("preset", "recipe"), "recipe"),
    ];
    for (text, part) in cases {
        fs::write(&path, text).expect("written");
        let sentence = Shard::read(&path).expect_err(part).to_string();
        assert!(sentence.contains("shard.json: ") && sentence.contains(part), "{sentence}");
    }
}
