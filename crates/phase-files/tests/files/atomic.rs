//! Files are complete or absent.

use phase_files::atomic::{self, AtomicFile};
use std::{
    fs,
    io::Write,
    sync::atomic::{AtomicBool, Ordering},
};

fn names(folder: &std::path::Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn a_file_appears_when_it_is_finished() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("event.json");
    let mut file = AtomicFile::create(&path).expect("created");
    file.write_all(b"half").expect("written");
    file.flush().expect("flushed");
    assert!(!path.exists());
    assert!(names(folder.path()).iter().all(|name| atomic::is_part(name)));
    file.write_all(b" and half").expect("written");
    file.commit().expect("committed");
    assert_eq!(names(folder.path()), ["event.json"]);
    assert_eq!(fs::read(&path).expect("read"), b"half and half");
}

#[test]
fn an_unfinished_file_leaves_the_old_one_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("event.json");
    atomic::write(&path, b"old").expect("written");
    let mut file = AtomicFile::create(&path).expect("created");
    file.write_all(b"new").expect("written");
    drop(file);
    assert_eq!(names(folder.path()), ["event.json"]);
    assert_eq!(fs::read(&path).expect("read"), b"old");
    atomic::write(&path, b"newer").expect("written");
    assert_eq!(fs::read(&path).expect("read"), b"newer");
}

#[test]
fn what_cannot_be_written_is_named_and_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("missing").join("event.json");
    let sentence = atomic::write(&path, b"text").expect_err("no folder").to_string();
    assert!(sentence.contains("event.json") && sentence.contains("cannot write the file"), "{sentence}");
    assert!(!sentence.contains("os error"), "{sentence}");
    // A folder of that name cannot be replaced by a file.
    let taken = folder.path().join("taken");
    fs::create_dir_all(taken.join("inside")).expect("a folder");
    atomic::write(&taken, b"text").expect_err("a folder");
    assert_eq!(names(folder.path()), ["taken"]);
}

/// A device or a pipe is not replaced by a file, which whoever runs this may be allowed to do.
#[cfg(unix)]
#[test]
fn what_is_no_regular_file_is_not_replaced() {
    use std::os::unix::fs::{FileTypeExt as _, symlink};
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let made = std::process::Command::new("mkfifo").arg(at("pipe")).status().expect("mkfifo");
    assert!(made.success());
    symlink(at("pipe"), at("link")).expect("a link");
    symlink("/proc/self/fd/1", at("stdout")).expect("a link");
    for name in ["pipe", "link", "stdout"] {
        let sentence = atomic::write(&at(name), b"text").expect_err(name).to_string();
        assert!(sentence.contains("no regular file"), "{sentence}");
        assert!(fs::symlink_metadata(at(name)).is_ok_and(|about| !about.is_file()), "{name}");
    }
    assert!(fs::metadata(at("pipe")).expect("there").file_type().is_fifo());
    assert_eq!(names(folder.path()), ["link", "pipe", "stdout"]);
}

#[test]
fn removing_what_is_not_there_is_fine() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("event.json");
    atomic::remove(&path).expect("nothing to do");
    fs::write(&path, "text").expect("written");
    atomic::remove(&path).expect("removed");
    assert!(!path.exists());
}

/// What a killed program has left is removed, what is being written and what belongs to others is not.
#[test]
fn abandoned_parts_are_removed() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("weights");
    let left = [".weights.17.3.part", ".weights.json.17.3.part", ".weights.part", ".weights.17.x.part"];
    for name in left {
        fs::write(folder.path().join(name), "half").expect("written");
    }
    let open = AtomicFile::create(&path).expect("created");
    atomic::remove_abandoned(&path);
    for name in left {
        assert_eq!(folder.path().join(name).exists(), name != ".weights.17.3.part", "{name}");
    }
    open.commit().expect("still there");
    assert!(path.exists());
}

/// A writer that begins a file removes what others have left of it, and nothing of those that are writing it.
#[test]
fn files_that_are_being_written_are_not_taken_for_abandoned() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("weights");
    let done = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let remover = scope.spawn(|| {
            while !done.load(Ordering::Relaxed) {
                atomic::remove_abandoned(&path);
            }
        });
        let written: Result<(), _> = (0..500_u32).try_for_each(|k| atomic::write(&path, &k.to_le_bytes()));
        done.store(true, Ordering::Relaxed);
        remover.join().expect("removed");
        written.expect("every file is written");
    });
    assert_eq!(fs::read(&path).expect("the last"), 499_u32.to_le_bytes());
}
