//! A cache gives back what was stored, or nothing.

use crate::support::plain_event;
use phase_dataset::cache::Cache;
use std::fs;

const SEED: u64 = u64::MAX - 3;

#[test]
fn what_was_stored_comes_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = Cache::new(folder.path(), [7; 32]);
    let event = plain_event(3);
    assert_eq!(cache.load("a", SEED), None);
    cache.store("a", &event).expect("stored");
    assert_eq!(cache.load("a", SEED), Some(event));
}

#[test]
fn another_id_seed_or_fingerprint_finds_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = Cache::new(folder.path(), [7; 32]);
    cache.store("a", &plain_event(1)).expect("stored");
    fs::copy(folder.path().join("a.bin"), folder.path().join("b.bin")).expect("copied");
    assert_eq!(cache.load("b", SEED), None, "a renamed file");
    assert_eq!(cache.load("a", SEED - 1), None, "another seed");
    assert_eq!(Cache::new(folder.path(), [8; 32]).load("a", SEED), None, "other settings");
    assert!(cache.load("a", SEED).is_some());
}

#[test]
fn damage_anywhere_is_noticed() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = Cache::new(folder.path(), [7; 32]);
    cache.store("a", &plain_event(1)).expect("stored");
    let path = folder.path().join("a.bin");
    let good = fs::read(&path).expect("read");
    for position in (0..good.len()).step_by(7).chain([good.len() - 1]) {
        let mut bad = good.clone();
        bad[position] ^= 0x40;
        fs::write(&path, &bad).expect("written");
        assert_eq!(cache.load("a", SEED), None, "byte {position} of {}", good.len());
    }
    for bytes in [&b""[..], b"PHASEch1", &good[..good.len() - 1], b"something else altogether"] {
        fs::write(&path, bytes).expect("written");
        assert_eq!(cache.load("a", SEED), None);
    }
    let longer = [&good[..], b"x"].concat();
    fs::write(&path, longer).expect("written");
    assert_eq!(cache.load("a", SEED), None, "something after the end");
    fs::write(&path, good).expect("written");
    assert!(cache.load("a", SEED).is_some());
}
