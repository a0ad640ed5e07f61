//! Files in a dataset's folder that are no part of it.

use crate::verify::{dataset, found};
use phase_dataset::verify::{Check, verify_with};
use std::{fs, path::Path};

/// Leftovers of systems, of Git and of programs that download datasets are told apart from damage; under
/// the same names, links, folders and our own leftovers are damage.
#[test]
fn what_systems_leave_is_no_damage() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let manifest = dataset(path);
    let left = [".DS_Store", ".cache/huggingface", ".git", ".gitattributes", "events/._made-up-1.json"];
    fs::create_dir_all(path.join(".cache/huggingface/download")).expect("made");
    fs::create_dir(path.join(".git")).expect("made");
    for file in [".cache/huggingface/download/a.lock", ".git/HEAD", left[0], left[3], left[4]] {
        fs::write(path.join(file), "left").expect("written");
    }
    let mut noted = Vec::new();
    let mut note = |file: &Path| {
        noted.push(file.strip_prefix(path).expect("below").to_string_lossy().into_owned());
    };
    let in_order = |count: usize, check: &Check<'_>| Ok::<_, ()>((0..count).map(check).collect());
    let problems = verify_with(path, &manifest, &|_| {}, &mut note, in_order).expect("checked");
    assert!(problems.is_empty(), "{problems:?}");
    noted.sort();
    assert_eq!(noted, left);

    let damage = |what: &str| {
        let found = found(path, &manifest);
        assert!(found.len() == 1 && found[0].starts_with(&format!("{what}: is ")), "{found:?}");
    };
    for file in [".cache/event.json", "events/.git"] {
        fs::write(path.join(file), "").expect("written");
        damage(file);
        fs::remove_file(path.join(file)).expect("removed");
    }
    fs::create_dir(path.join("events/Thumbs.db")).expect("made");
    damage("events/Thumbs.db");
    fs::remove_dir(path.join("events/Thumbs.db")).expect("removed");
    #[cfg(unix)]
    {
        fs::remove_file(path.join(".DS_Store")).expect("removed");
        std::os::unix::fs::symlink("README.md", path.join(".DS_Store")).expect("a link");
        damage(".DS_Store");
    }
}
