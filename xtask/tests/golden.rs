//! Every file of a small dataset is pinned byte for byte.

use phase_golden::{Digest, Golden};
use std::{
    fs, io,
    path::{Path, PathBuf},
    process::Command,
};

#[test]
fn golden_dataset_is_unchanged() -> Result<(), String> {
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let out = folder.path().join("dataset");
    let output = Command::new(env!("CARGO_BIN_EXE_xtask"))
        .args(["gen-dataset", "--events", "3", "--simulations", "20", "--particles", "5", "--out"])
        .arg(&out)
        .output()
        .map_err(|error| error.to_string())?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    let mut files = Vec::new();
    collect(&out, &mut files).map_err(|error| error.to_string())?;
    files.sort();
    let mut golden = Golden::new(env!("CARGO_MANIFEST_DIR"), "dataset");
    for file in files {
        let mut digest = Digest::new();
        digest.bytes(&fs::read(&file).map_err(|error| error.to_string())?);
        let name = file.strip_prefix(&out).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        golden.add(name, digest.hex());
    }
    golden.check()
}

/// All files below a folder.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect(&path, files)?;
        } else {
            files.push(path);
        }
    }
    Ok(())
}
