//! A file is described as it is on the disk.

use phase_files::{
    checksum::FileEntry,
    measured::{self, MeasuredFile},
};
use std::{fs, io::Write};

#[test]
fn a_description_is_what_reading_the_file_gives() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("data")).expect("a folder");
    let bytes: Vec<u8> = (0..100_003_u32).map(|k| (k % 251) as u8).collect();
    let written = measured::write(folder.path(), "data/long", &bytes).expect("written");
    assert_eq!(written, FileEntry::of(folder.path(), "data/long").expect("measured"));
    assert_eq!(written.bytes, 100_003);

    let mut file = MeasuredFile::create(folder.path(), "parts").expect("created");
    bytes.chunks(977).for_each(|part| file.write_all(part).expect("written"));
    let so_far = file.entry();
    assert_eq!(so_far.sha256, written.sha256);
    assert_eq!(file.commit().expect("committed"), FileEntry::of(folder.path(), "parts").expect("measured"));
}

#[test]
fn what_cannot_be_written_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    for path in ["missing/file", "../out", "/out", ""] {
        let error = measured::write(&folder.path().join("in"), path, b"text").expect_err(path).to_string();
        assert!(error.contains("cannot write the file"), "{path}: {error}");
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
}
