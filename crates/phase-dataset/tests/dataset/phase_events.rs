//! Error messages about event files that cannot be read.

use phase_dataset::phase_events::read;
use phase_files::Problem;
use phase_model::json::JsonError;

#[test]
fn files_that_cannot_be_read_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let missing = folder.path().join("missing.json");
    let sentence = read(&missing).expect_err("missing").to_string();
    assert!(sentence.contains("missing.json") && sentence.contains("no such file"), "{sentence}");
    let error = read(folder.path()).expect_err("a folder");
    assert!(matches!(error.problem, Problem::IsFolder), "{error}");
    let path = folder.path().join("bad.json");
    std::fs::write(&path, "{\"format\":").expect("written");
    let error = read(&path).expect_err("truncated");
    assert_eq!(error.file, path);
    assert!(matches!(error.problem, Problem::Json(JsonError::Truncated(1))), "{error}");
}
