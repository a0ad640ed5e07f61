//! Folders that are whole or absent.

use phase_files::{folder::FolderError, new_folder::NewFolder};
use std::{
    fs,
    path::{Path, PathBuf},
};

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").map(|it| it.expect("an entry").file_name());
    let mut names: Vec<String> = entries.map(|name| name.to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// A place for the folder: one that is not there, and one that is, with a file of the system in it.
fn places(parent: &Path) -> [PathBuf; 2] {
    let there = parent.join("there");
    fs::create_dir(&there).expect("a folder");
    fs::write(there.join(".DS_Store"), "").expect("written");
    [parent.join("not/there"), there]
}

#[test]
fn its_files_appear_together() {
    let parent = tempfile::tempdir().expect("a folder");
    for path in places(parent.path()) {
        let new = NewFolder::create(&path).expect("begun");
        new.write("a/b.txt", b"one").expect("written");
        new.write("c.txt", b"two").expect("written");
        assert!(!path.join("a").exists() && !path.join("c.txt").exists());
        new.commit().expect("named");
        assert_eq!(fs::read(path.join("a/b.txt")).expect("there"), b"one");
        let seen: Vec<String> = names(&path).into_iter().filter(|name| name != ".DS_Store").collect();
        assert_eq!(seen, ["a", "c.txt"]);
    }
    assert_eq!(names(parent.path()), ["not", "there"]);
    assert_eq!(names(&parent.path().join("not")), ["there"]);
}

#[test]
fn nothing_is_left_of_one_that_is_not_finished() {
    let parent = tempfile::tempdir().expect("a folder");
    let [path, there] = places(parent.path());
    for path in [&path, &there] {
        let new = NewFolder::create(path).expect("begun");
        new.write("a.txt", b"one").expect("written");
        let error = new.write("a.txt/b.txt", b"two").expect_err("a file is in the way");
        assert!(error.path.starts_with(path), "{error}");
    }
    assert!(!path.exists());
    assert_eq!(names(&parent.path().join("not")).len(), 0);
    assert_eq!(names(&there), [".DS_Store"]);
}

#[test]
fn what_is_there_is_not_touched() {
    let parent = tempfile::tempdir().expect("a folder");
    let path = parent.path().join("folder");
    let new = NewFolder::create(&path).expect("begun");
    new.write("a.txt", b"one").expect("written");
    // Somebody else is faster.
    fs::create_dir(&path).expect("a folder");
    fs::write(path.join("a.txt"), "mine").expect("written");
    assert!(matches!(new.commit(), Err(FolderError::Foreign { .. })));
    let again = NewFolder::create(&path).expect_err("not empty");
    assert!(matches!(again, FolderError::Foreign { .. }), "{again}");
    let file = NewFolder::create(&path.join("a.txt")).expect_err("a file");
    assert!(matches!(file, FolderError::IsFile(_)), "{file}");
    assert!(NewFolder::create(&path.join("a.txt/b")).is_err());
    assert_eq!(fs::read(path.join("a.txt")).expect("there"), b"mine");
    assert_eq!(names(parent.path()), ["folder"]);
}

#[cfg(unix)]
#[test]
fn what_killed_programs_left_is_removed_and_what_others_fill_is_not() {
    let parent = tempfile::tempdir().expect("a folder");
    let [path, there] = places(parent.path());
    let left = [path.with_file_name(".there.17.3.part"), there.join(".new.17.3.part")];
    for left in &left {
        fs::create_dir_all(left).expect("a folder");
        fs::write(left.join("a.txt"), "half").expect("written");
    }
    let [beside, inside] = [&path, &there].map(|path| NewFolder::create(path).expect("begun"));
    assert!(left.iter().all(|left| !left.exists()));
    let second = NewFolder::create(&path).expect("another program begins the same");
    assert!(beside.part().exists() && second.part() != beside.part());
    assert!(matches!(NewFolder::create(&there), Err(FolderError::Busy(_))));
    inside.commit().expect("named");
    beside.commit().expect("named");
    // An empty folder is in nobody's way.
    second.write("a.txt", b"whole").expect("written");
    second.commit().expect("named");
    assert_eq!(names(&path), ["a.txt"]);
    assert_eq!(names(&parent.path().join("not")), ["there"]);
}

#[cfg(unix)]
#[test]
fn a_private_one_is_its_owners_alone() {
    use std::os::unix::fs::PermissionsExt as _;
    let parent = tempfile::tempdir().expect("a folder");
    let path = parent.path().join("folder");
    let new = NewFolder::create_private(&path).expect("begun");
    new.write("data/a.txt", b"one").expect("written");
    new.commit().expect("named");
    for inside in ["", "data", "data/a.txt"] {
        let mode = fs::metadata(path.join(inside)).expect("there").permissions().mode();
        assert_eq!(mode & 0o077, 0, "{inside}");
    }
}
