//! Only regular files are read, and no more of them than fits.

use phase_files::{FileError, Problem, atomic, checksum::FileEntry, folder, json, regular, run::Run};
use std::{fs, path::Path};

fn problem<T>(result: Result<T, FileError>) -> Problem {
    result.err().expect("refused").problem
}

/// Makes a pipe; whether there is one.
fn pipe(path: &Path) -> bool {
    cfg!(unix) && std::process::Command::new("mkfifo").arg(path).status().is_ok_and(|status| status.success())
}

#[test]
fn pipes_devices_and_folders_are_refused_at_once() {
    let place = tempfile::tempdir().expect("a folder");
    let at = |name: &str| place.path().join(name);
    if pipe(&at("pipe")) {
        assert!(matches!(problem(regular::open(&at("pipe"))), Problem::NoFile));
        assert!(matches!(problem(json::read(&at("pipe"))), Problem::NoFile));
        assert!(matches!(problem(FileEntry::of(place.path(), "pipe")), Problem::NoFile));
    }
    if Path::new("/dev/zero").exists() {
        assert!(matches!(problem(regular::bytes(Path::new("/dev/zero"))), Problem::NoFile));
    }
    assert!(matches!(problem(regular::bytes(place.path())), Problem::IsFolder));
    assert!(matches!(problem(regular::bytes(&at("absent"))), Problem::Unreadable(_)));
}

#[test]
fn a_file_is_read_up_to_its_limit() {
    let place = tempfile::tempdir().expect("a folder");
    let file = place.path().join("file");
    fs::write(&file, [7; 10]).expect("written");
    assert_eq!(regular::bytes_within(&file, 10).expect("read"), [7; 10]);
    assert!(matches!(problem(regular::bytes_within(&file, 9)), Problem::TooLarge { largest: 9 }));
    // It has no bytes on disk.
    fs::File::create(&file).and_then(|file| file.set_len(1 << 40)).expect("a file with a hole");
    assert!(matches!(problem(regular::bytes(&file)), Problem::TooLarge { .. }));
    fs::write(&file, [b'a', 0xff]).expect("written");
    assert!(matches!(problem(regular::text(&file)), Problem::Json(_)));
}

#[test]
fn a_folder_with_pipes_in_the_way_keeps_nobody_waiting() {
    let place = tempfile::tempdir().expect("a folder");
    let at = |name: &str| place.path().join(name);
    if !pipe(&at(".phase-lock")) {
        eprintln!("skipped: there are no pipes");
        return;
    }
    let run = Run::new([("command", "test".into())]);
    assert!(folder::Folder::claim(place.path(), &run).is_err());
    assert!(pipe(&at(".x.1.0.part")));
    atomic::remove_abandoned(&at("x"));
    let this = std::process::id();
    for count in 0..100 {
        assert!(pipe(&at(&format!(".y.{this}.{count}.part"))));
    }
    atomic::write(&at("y"), b"whole").expect("written beside the pipes");
    assert_eq!(fs::read(at("y")).expect("read"), b"whole");
}

#[test]
fn what_others_named_is_shown_as_letters() {
    let place = tempfile::tempdir().expect("a folder");
    let evil = "evil\u{1b}[31m\u{202e}";
    if fs::write(place.path().join(evil), "").is_err() {
        eprintln!("skipped: there are no such names here");
        return;
    }
    let unseen = |text: &str| text.contains(['\u{1b}', '\u{202e}']);
    let error = folder::inspect(place.path(), "last").expect_err("foreign").to_string();
    assert!(!unseen(&error) && error.contains("evil"), "{error:?}");
    let error = json::read(&place.path().join(evil)).expect_err("empty").to_string();
    assert!(!unseen(&error) && error.contains("evil"), "{error:?}");
}
