//! Checksums of files.

use phase_files::{
    Problem,
    checksum::{FileEntry, hexadecimal, sha256},
};
use serde_json::json;
use std::fs;

#[test]
fn checksums_are_sha_256() {
    // The examples of FIPS 180-2.
    assert_eq!(
        hexadecimal(&sha256(b"abc")),
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
    );
    assert_eq!(hexadecimal(&sha256(b"")), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

#[test]
fn a_file_longer_than_a_buffer_is_measured_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let bytes: Vec<u8> = (0..200_001_u32).map(|k| (k % 251) as u8).collect();
    fs::write(folder.path().join("long"), &bytes).expect("written");
    let entry = FileEntry::of(folder.path(), "long").expect("measured");
    assert_eq!((entry.bytes, entry.sha256), (200_001, hexadecimal(&sha256(&bytes))));
}

#[test]
fn changes_are_noticed() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("file");
    fs::write(&path, "text").expect("written");
    let entry = FileEntry::of(folder.path(), "file").expect("measured");
    entry.verify(folder.path()).expect("unchanged");
    for (text, expected) in [("tex", "size"), ("tert", "checksum")] {
        fs::write(&path, text).expect("written");
        let error = entry.verify(folder.path()).expect_err(text);
        assert_eq!(error.file, path);
        assert!(matches!(error.problem, Problem::Altered(what) if what == expected), "{error}");
    }
    fs::remove_file(&path).expect("removed");
    let error = entry.verify(folder.path()).expect_err("gone");
    assert!(matches!(error.problem, Problem::Unreadable(_)));
}

#[test]
fn a_path_that_leads_out_of_the_folder_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("inside")).expect("a folder");
    fs::write(folder.path().join("secret"), "text").expect("written");
    let inside = folder.path().join("inside");
    let absolute = folder.path().join("secret").to_string_lossy().into_owned();
    for path in ["../secret", "", "a/../../secret", absolute.as_str()] {
        let error = FileEntry::of(&inside, path).expect_err(path);
        assert!(matches!(error.problem, Problem::Path(_)), "{path}: {error}");
        let text = json!({ "path": path, "bytes": 4, "sha256": hexadecimal(&sha256(b"text")) }).to_string();
        let error = serde_json::from_str::<FileEntry>(&text).expect_err(path).to_string();
        assert!(error.contains(&format!("the path {path:?} must")), "{path}: {error}");
    }
}

/// To open a pipe would wait for whoever writes into it.
#[test]
#[cfg(unix)]
fn what_is_no_file_is_not_opened() {
    let folder = tempfile::tempdir().expect("a folder");
    let made = std::process::Command::new("mkfifo").arg(folder.path().join("pipe")).status();
    assert!(made.expect("mkfifo").success());
    let error = FileEntry::of(folder.path(), "pipe").expect_err("a pipe");
    assert!(matches!(error.problem, Problem::NoFile), "{error}");
}
