//! A cache gives back what was stored, or nothing.

use phase_files::cache::Cache;
use std::fs;

const SEED: u64 = u64::MAX - 3;

fn result() -> (u32, Vec<f64>, String) {
    (7, (0..40).map(|k| f64::from(k).sqrt()).collect(), "a text".into())
}

fn load(cache: &Cache, id: &str, seed: u64) -> Option<(u32, Vec<f64>, String)> {
    cache.load(id, seed)
}

#[test]
fn a_result_comes_back_under_its_own_id_seed_and_fingerprint_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = Cache::new(folder.path(), [7; 32]);
    assert_eq!(load(&cache, "a", SEED), None);
    cache.store("a", SEED, &result()).expect("stored");
    assert_eq!(load(&cache, "a", SEED), Some(result()));
    fs::copy(folder.path().join("a.bin"), folder.path().join("b.bin")).expect("copied");
    assert_eq!(load(&cache, "b", SEED), None, "a renamed file");
    assert_eq!(load(&cache, "a", SEED - 1), None, "another seed");
    assert_eq!(load(&Cache::new(folder.path(), [8; 32]), "a", SEED), None, "other settings");
}

#[test]
fn damage_anywhere_is_noticed() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = Cache::new(folder.path(), [7; 32]);
    cache.store("a", SEED, &result()).expect("stored");
    let path = folder.path().join("a.bin");
    let good = fs::read(&path).expect("read");
    for position in 0..good.len() {
        let mut bad = good.clone();
        bad[position] ^= 0x40;
        fs::write(&path, &bad).expect("written");
        assert_eq!(load(&cache, "a", SEED), None, "byte {position} of {}", good.len());
    }
    let longer = [&good[..], b"x"].concat();
    for bytes in [&b""[..], b"PHASEch1", &good[..good.len() - 1], b"something else altogether", &longer] {
        fs::write(&path, bytes).expect("written");
        assert_eq!(load(&cache, "a", SEED), None);
    }
    fs::write(&path, good).expect("written");
    assert_eq!(load(&cache, "a", SEED), Some(result()));
}
