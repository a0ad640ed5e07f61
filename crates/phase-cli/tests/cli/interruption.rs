//! An interrupted run resumes, with the same result as without the interruption.
#![cfg(unix)]

use crate::support::{phase, recording, refuse, succeed, text, tree, write_events};
use std::{
    io::{BufRead, BufReader},
    path::Path,
    process::{Child, Command, Stdio},
    time::{Duration, Instant},
};

const COMMAND: [&str; 10] =
    ["gen-dataset", "--events", "3", "--simulations", "80", "--max-steps", "10", "--jobs", "1", "--out"];

fn generate(out: &str) -> Vec<&str> {
    [&COMMAND[..], &[out]].concat()
}

/// Starts a run and waits until its first event is finished; the line before describes the activity.
fn start(folder: &Path, out: &str) -> Child {
    start_run(folder, &generate(out))
}

fn start_run(folder: &Path, arguments: &[&str]) -> Child {
    let mut child = phase(folder).args(arguments).stderr(Stdio::piped()).spawn().expect("the program starts");
    let stderr = child.stderr.take().expect("a pipe");
    let line = BufReader::new(stderr).lines().nth(1).expect("a line").expect("text");
    assert!(line.starts_with("1/"), "{line}");
    child
}

fn signal(child: &Child, name: &str) {
    let status = Command::new("kill").args([name, &child.id().to_string()]).status();
    assert!(status.expect("kill runs").success());
}

#[test]
fn an_interrupted_run_is_resumed_to_the_same_bytes() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    succeed(path, &generate("straight"));
    let straight = tree(&path.join("straight"));
    for (name, code) in [("-INT", Some(130)), ("-TERM", Some(130)), ("-KILL", None)] {
        let out = format!("stopped{name}");
        let mut child = start(path, &out);
        signal(&child, name);
        assert_eq!(child.wait().expect("it ends").code(), code, "{name}");
        let stopped = tree(&path.join(&out));
        assert!(!stopped.contains_key(Path::new("manifest.json")), "{name}: it was finished already");
        assert!(stopped.contains_key(Path::new("events/demo-0000.json")), "{name}");

        if name == "-TERM" {
            // It is the same as -INT from here on.
            continue;
        }
        let other = [&generate(&out)[..], &["--seed", "77"]].concat();
        let sentence = refuse(path, &other);
        assert!(sentence.contains("unfinished") && sentence.contains("seed 1 instead of 77"), "{sentence}");

        let other = [&generate(&out)[..], &["--engine", "forward"]].concat();
        let sentence = refuse(path, &other);
        let difference = r#"settings.engine "world" instead of "forward""#;
        assert!(sentence.contains("unfinished") && sentence.contains(difference), "{sentence}");

        let output = phase(path).args(generate(&out)).output().expect("the program starts");
        assert!(output.status.success(), "{name}: {}", text(&output.stderr));
        let told = text(&output.stderr);
        let kept = |line: &str| line.contains("demo-0000 helping, ") && line.ends_with(": 10 steps (kept)");
        assert!(told.lines().any(kept), "{told}");
        assert!(tree(&path.join(&out)) == straight, "{name}: the resumed run differs");
    }
}

/// A run that is killed once its first event is finished.
fn kill(folder: &Path, out: &str) {
    let mut child = start(folder, out);
    signal(&child, "-KILL");
    child.wait().expect("it ends");
}

#[test]
fn a_damaged_cache_is_made_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    succeed(path, &generate("straight"));
    kill(path, "out");
    std::fs::write(path.join("out/.cache/demo-0000.json"), "rubbish").expect("written");
    std::fs::write(path.join("out/events/demo-0000.json"), "rubbish").expect("written");
    let output = phase(path).args(generate("out")).output().expect("the program starts");
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(!text(&output.stderr).contains("kept"), "{}", text(&output.stderr));
    assert!(tree(&path.join("out")) == tree(&path.join("straight")));
}

#[test]
fn a_damaged_video_is_made_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    succeed(path, &generate("straight"));
    kill(path, "out");
    std::fs::write(path.join("out/videos/demo-0000.mp4"), "rubbish").expect("written");
    succeed(path, &generate("out"));
    assert!(tree(&path.join("out")) == tree(&path.join("straight")));
}

#[test]
fn two_runs_in_one_folder_do_not_mix() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    // So many events that the run is still going on however busy the machine is.
    let long = generate("out").into_iter().map(|word| if word == "3" { "500" } else { word });
    let long: Vec<&str> = long.collect();
    let mut child = start_run(path, &long);
    let sentence = refuse(path, &["gen-dataset", "--events", "3", "--out", "out"]);
    assert!(sentence.contains("unfinished run of another kind"), "{sentence}");
    let output = phase(path).args(&long).output().expect("the program starts");
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("is in use by another run"), "{}", text(&output.stderr));
    signal(&child, "-INT");
    assert_eq!(child.wait().expect("it ends").code(), Some(130), "the first run was not disturbed");
}

/// Also within one event that takes minutes to draw.
#[test]
fn a_long_video_is_given_up_at_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let mut long = recording("long");
    for group in ["agents", "objects"] {
        for rows in long["trajectory"][group].as_array_mut().expect("tracks") {
            *rows = vec![rows[0].clone(); 20_000].into();
        }
    }
    write_events(&path.join("long.json"), &[long]);
    let options = ["render", "long.json", "--out", "long.mp4"];
    let mut child = phase(path).args(options).stderr(Stdio::piped()).spawn().expect("the program starts");
    let mut lines = BufReader::new(child.stderr.take().expect("a pipe")).lines();
    assert!(lines.next().expect("a line").expect("text").contains("rendering"));
    let told = Instant::now();
    signal(&child, "-TERM");
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    // The whole video takes minutes.
    assert!(told.elapsed() < Duration::from_secs(30), "{:?}", told.elapsed());
    assert!(!path.join("long.mp4").exists());
}
