//! Folders of runs, and the run that each belongs to.

use phase_files::{
    folder::{self, Contents, Folder, FolderError},
    run::Run,
};
use std::fs;

const LAST: &str = "manifest.json";

fn run() -> Run {
    Run::new([("seed", 1.into())])
}

#[test]
fn a_folder_is_new_then_unfinished_then_finished() {
    let parent = tempfile::tempdir().expect("a folder");
    let path = parent.path().join("new").join("deeper");
    assert_eq!(folder::inspect(&path, LAST).expect("usable"), Contents::Nothing);
    assert!(!path.exists(), "looking must not touch");

    let run = run();
    let claimed = Folder::claim(&path, &run).expect("claimed");
    assert_eq!(folder::inspect(&path, LAST).expect("usable"), Contents::Unfinished(run.value().clone()));
    assert!(claimed.cache().is_dir());
    fs::write(claimed.cache().join("event.bin"), "kept").expect("written");
    drop(claimed);

    // An interrupted run, perhaps in the middle of a file.
    fs::create_dir(path.join("events")).expect("a folder");
    fs::write(path.join("events").join(".a.json.17.part"), "half").expect("written");
    assert_eq!(folder::inspect(&path, LAST).expect("usable"), Contents::Unfinished(run.value().clone()));
    let claimed = Folder::claim(&path, &run).expect("claimed again");
    assert!(claimed.cache().join("event.bin").exists());
    claimed.subfolder("events").expect("there already");
    assert_eq!(fs::read_dir(path.join("events")).expect("a folder").count(), 0, "half files are cleared");

    fs::write(path.join(LAST), "{}").expect("written");
    // It ends before it can remove what served it.
    drop(claimed);
    assert!(path.join(".phase-lock").exists());
    folder::remove_leftovers(&path, &run).expect("finished");
    assert_eq!(folder::inspect(&path, LAST).expect("usable"), Contents::Finished);
    let mut names: Vec<_> =
        fs::read_dir(&path).expect("a folder").map(|it| it.expect("an entry").file_name()).collect();
    names.sort();
    assert_eq!(names, ["events", LAST]);
    folder::remove_leftovers(&path, &run).expect("nothing to do");
}

#[test]
fn an_empty_folder_is_accepted() {
    let folder = tempfile::tempdir().expect("a folder");
    assert_eq!(folder::inspect(folder.path(), LAST).expect("usable"), Contents::Nothing);
}

#[test]
fn what_is_not_ours_is_left_alone() {
    for name in ["notes.txt", "README.md", "events", ".phase-run.json"] {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join(name), "someone's").expect("written");
        let error = folder::inspect(folder.path(), LAST).expect_err(name);
        assert!(matches!(&error, FolderError::Foreign { entry, .. } if entry == name), "{error}");
        assert!(error.to_string().contains(&folder.path().display().to_string()));
    }
}

#[test]
fn a_file_is_no_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("file");
    fs::write(&file, "text").expect("written");
    assert!(matches!(folder::inspect(&file, LAST), Err(FolderError::IsFile(_))));
    let below = file.join("below");
    assert_eq!(folder::inspect(&below, LAST).expect("nothing there"), Contents::Nothing);
    let error = Folder::claim(&below, &run()).expect_err("cannot be created");
    assert!(matches!(error, FolderError::NotWritable(_)), "{error}");
    assert_eq!(fs::read_to_string(&file).expect("untouched"), "text");
}

#[test]
fn two_runs_do_not_meet_in_one_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("out");
    let first = Folder::claim(&path, &run()).expect("claimed");
    let error = Folder::claim(&path, &run()).expect_err("busy");
    assert!(matches!(error, FolderError::Busy(_)), "{error}");
    drop(first);
    Folder::claim(&path, &run()).expect("free again");
}

#[test]
fn a_run_of_an_earlier_version_is_named_and_left_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let marker = path.join(".phase-run.json");
    fs::write(&marker, r#"{"format":"phase-run/1","run":{"seed":1}}"#).expect("written");
    let error = folder::inspect(path, LAST).expect_err("it cannot be compared");
    let sentence = error.to_string();
    assert!(sentence.contains(&path.display().to_string()), "{sentence}");
    assert!(sentence.contains("an earlier version of PHASE") && sentence.contains("--out"), "{sentence}");
    assert!(matches!(error, FolderError::EarlierRun(_)), "{error:?}");
    assert!(fs::read_to_string(&marker).expect("there").contains("phase-run/1"));
}
