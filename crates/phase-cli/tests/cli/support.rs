//! Running the program, `crate::PROGRAM`, and inspecting its output.

use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

/// Options that make events short and searches small.
pub(crate) const QUICK: [&str; 6] = ["--simulations", "20", "--particles", "10", "--max-steps", "4"];

/// The program, to be run in a folder.
pub(crate) fn phase(folder: &Path) -> Command {
    let mut command = Command::new(crate::PROGRAM);
    command.current_dir(folder);
    command
}

/// Runs the program to its end.
pub(crate) fn run(folder: &Path, arguments: &[&str]) -> Output {
    phase(folder).args(arguments).output().expect("the program starts")
}

/// Runs the program and checks that it succeeds.
pub(crate) fn succeed(folder: &Path, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    text(&output.stdout)
}

/// Runs the program and checks that it fails with one plain sentence, which is returned.
pub(crate) fn refuse(folder: &Path, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    let sentence = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {sentence}");
    assert_eq!(sentence.lines().count(), 1, "{arguments:?}: {sentence}");
    assert!(sentence.starts_with("error: "), "{arguments:?}: {sentence}");
    for trace in ["panicked", "RUST_BACKTRACE", "Error {", "Os {", "os error"] {
        assert!(!sentence.contains(trace), "{arguments:?}: {sentence}");
    }
    sentence
}

/// Runs the program and checks that it fails because of its input after it has begun: the activity, then one
/// plain sentence, which is returned.
pub(crate) fn fail(folder: &Path, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    let told = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {told}");
    let errors: Vec<&str> = told.lines().filter(|line| line.starts_with("error: ")).collect();
    assert_eq!((errors.len(), told.lines().last()), (1, errors.first().copied()), "{arguments:?}: {told}");
    errors.concat()
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Every file below a folder with its contents.
pub(crate) fn tree(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    collect(folder, folder, &mut files);
    files
}

fn collect(root: &Path, folder: &Path, files: &mut BTreeMap<PathBuf, Vec<u8>>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            collect(root, &path, files);
        } else {
            let name = path.strip_prefix(root).expect("below the root").to_owned();
            files.insert(name, fs::read(&path).expect("readable"));
        }
    }
}

/// A recording of four steps in which both agents stand still, in the open; they want to go to landmarks.
pub(crate) fn recording(id: &str) -> Value {
    let still = |x: f64, y: f64| vec![json!([x, y, 0.0, 0.0, 0.5]); 5];
    let agent = |number: u8, landmark: u8| {
        json!({
            "size_level": 0, "strength_level": 2, "alpha": 0,
            "goal": {"kind": "agent_on_landmark", "agent": number, "landmark": landmark, "sign": 1},
        })
    };
    json!({
        "id": id,
        "layout": {"base": 0, "flip": null},
        "agents": [agent(0, 0), agent(1, 1)],
        "objects": [{"size_level": 1}],
        "event": "independent",
        "trajectory": {
            "columns": ["x", "y", "vx", "vy", "angle"],
            "agents": [still(8.5, 19.5), still(20.0, 8.0)],
            "objects": [still(12.0, 8.0)],
        },
    })
}

/// A file with the given events.
pub(crate) fn write_events(path: &Path, events: &[Value]) {
    let file = json!({"format": "phase-events/1", "events": events});
    fs::write(path, file.to_string()).expect("written");
}

/// Runs a command that fills the new folder `out` with a fault at each of its steps of writing: while the
/// disk is full, and killed. It then leaves nothing in that folder, and works afterwards.
pub(crate) fn whole_or_absent(path: &Path, arguments: &[&str]) {
    let arguments = [arguments, &["--out", "out"]].concat();
    let out = path.join("out");
    succeed(path, &arguments);
    let whole = tree(&out);
    let seen = || if out.exists() { tree(&out) } else { BTreeMap::new() };
    // A kill between the moves of files into a folder that was there is not provided for.
    for (fault, is_there) in [("full", false), ("full", true), ("kill", false)] {
        for step in 1.. {
            if out.exists() {
                fs::remove_dir_all(&out).expect("removed");
            }
            if is_there {
                fs::create_dir(&out).expect("a folder");
            }
            let output = phase(path).args(&arguments).env("PHASE_FAULT", format!("{fault}@{step}")).output();
            let output = output.expect("the program starts");
            if output.status.success() {
                assert!(step > whole.len(), "{arguments:?}: {fault} has no more than {step} steps");
                break;
            }
            let (told, left) = (text(&output.stderr), seen());
            assert_eq!(told.contains("error: "), fault == "full", "{told}");
            // A kill comes also when the folder has its name.
            assert!(left.is_empty() || (fault == "kill" && left == whole), "{arguments:?}: {fault}@{step}");
            assert_eq!(out.exists(), is_there || !left.is_empty(), "{arguments:?}: {fault}@{step}");
        }
        if seen().is_empty() {
            succeed(path, &arguments);
        }
        assert!(seen() == whole, "{arguments:?}");
    }
    let left = fs::read_dir(path).expect("a folder").map(|it| it.expect("an entry").file_name());
    let mut hidden = left.filter(|name| name.to_string_lossy().ends_with(".part"));
    assert_eq!(hidden.next(), None, "{arguments:?}");
}
