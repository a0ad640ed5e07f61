//! Files, folders and terminals that are not what a program hopes for.

use crate::support::{QUICK, phase, recording, refuse, run, succeed, text};
use serde_json::{Value, json};
use std::{
    fs::{self, File},
    path::Path,
    process::{Command, Stdio},
    thread,
    time::{Duration, Instant},
};

const DEMO: &str = include_str!("../../../../data/presets/demo.json");
/// Longest that a command may take to refuse a file.
const PATIENCE: Duration = Duration::from_secs(20);

fn dataset(path: &Path, out: &str) {
    let made = ["gen-dataset", "--events", "1", "--no-video", "--out", out];
    succeed(path, &[&made[..], &QUICK].concat());
}

fn save(path: &Path, name: &str, value: &Value) {
    fs::write(path.join(name), value.to_string()).expect("written");
}

fn events(path: &Path, name: &str) {
    save(path, name, &json!({ "format": "phase-events/1", "events": [recording("a")] }));
}

#[cfg(unix)]
#[test]
fn a_result_that_nobody_gets_is_no_success() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    dataset(path, "data");
    events(path, "events.json");
    let scene = ["new-scene", "--kind", "helping", "--out"];
    let again = [&["gen-dataset", "--events", "1", "--no-video", "--out", "data"][..], &QUICK].concat();
    let chance = ["eval", "goals", "--method", "chance", "--events", "events.json"];
    let commands: Vec<Vec<&str>> = vec![
        vec!["--help"],
        vec!["--version"],
        vec!["eval", "goals", "--help"],
        vec!["completions", "bash"],
        vec!["man", "--out", "man"],
        again,
        vec!["stats", "data"],
        vec!["stats", "data", "--json"],
        vec!["verify", "data"],
        vec!["verify", "data", "--json"],
        vec!["export", "data", "--out", "tar"],
        vec!["render", "events.json", "--contact-sheet", "1", "--out", "pictures"],
        [&chance[..], &["--out", "chance"]].concat(),
        [&chance[..], &["--out", "chance", "--json"]].concat(),
        [&["simulate", "--events", "events.json", "--no-video", "--out", "sim"][..], &QUICK].concat(),
        [&scene[..], &["scene-1.json"]].concat(),
    ];
    let full = File::options().write(true).open("/dev/full");
    for arguments in &commands {
        let (reader, closed) = std::io::pipe().expect("a pipe");
        drop(reader);
        let mut places = vec![("a closed pipe", Stdio::from(closed))];
        if let Ok(full) = &full {
            places.push(("a full disk", full.try_clone().expect("the same").into()));
        }
        for (place, stdout) in places {
            let _ = fs::remove_file(path.join("scene-1.json"));
            let mut command = phase(path);
            command.args(arguments).stdout(stdout).stderr(Stdio::piped());
            let output = command.spawn().and_then(std::process::Child::wait_with_output).expect("it starts");
            let told = text(&output.stderr);
            assert_eq!(output.status.code(), Some(1), "{arguments:?} to {place}: {told}");
            assert!(told.contains("cannot be written to stdout"), "{arguments:?} to {place}: {told}");
            assert!(!told.contains("panicked"), "{arguments:?} to {place}: {told}");
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_path_need_not_be_text() {
    use std::{ffi::OsStr, os::unix::ffi::OsStrExt as _};
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let name = |end: &[u8]| OsStr::from_bytes(&[b"n\xff-", end].concat()).to_owned();
    let works = |arguments: &[&str], folders: &[(&str, &[u8])]| {
        let mut command = phase(path);
        command.args(arguments);
        for (option, end) in folders {
            command.args(Some(option).filter(|option| !option.is_empty())).arg(name(end));
        }
        let output = command.output().expect("it starts");
        assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
        let told = String::from_utf8(output.stdout).expect("text");
        if arguments.contains(&"--json") {
            let value: Value = serde_json::from_str(&told).expect("JSON");
            assert!(value.to_string().contains("n\u{fffd}-"), "{arguments:?}: {told}");
        }
    };
    let made = ["gen-dataset", "--events", "1", "--no-video", "--json"];
    works(&[&made[..], &QUICK].concat(), &[("--out", b"data")]);
    works(&[&made[..], &QUICK].concat(), &[("--out", b"data")]);
    let shard = ["gen-dataset", "--events", "1", "--no-video", "--json", "--shard", "1/1"];
    works(&[&shard[..], &QUICK].concat(), &[("--out", b"shard")]);
    works(&["merge"], &[("", b"shard"), ("--out", b"merged")]);
    works(&["verify", "--json"], &[("", b"data")]);
    works(&["stats"], &[("", b"data"), ("--out", b"stats")]);
    works(&["export", "--json"], &[("", b"data"), ("--out", b"tar")]);
    works(&["new-scene", "--kind", "helping", "--json"], &[("--out", b"scene.json")]);
    works(&[&["simulate", "--json"][..], &QUICK].concat(), &[("--events", b"scene.json"), ("--out", b"sim")]);
    works(&["render", "--json"], &[("", b"sim"), ("--out", b"videos")]);
    works(&["render", "--json", "--observer"], &[("", b"sim"), ("--out", b"v.mp4")]);
    assert!(path.join(name(b"v.observer.json")).is_file());
    works(&["eval", "goals", "--method", "chance"], &[("--events", b"sim"), ("--out", b"eval")]);
    works(&["man"], &[("--out", b"man")]);
    works(&["splits", "--json"], &[("", b"data"), ("--make", b"splits.json")]);
}

#[cfg(unix)]
#[test]
fn pipes_and_devices_are_refused_at_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events(path, "events.json");
    let made = Command::new("mkfifo").arg(path.join("pipe.json")).status();
    assert!(made.expect("mkfifo").success());
    let chance = ["eval", "goals", "--events", "events.json", "--out", "out"];
    for file in ["pipe.json", "/dev/zero"] {
        let commands: Vec<Vec<&str>> = vec![
            vec!["render", file, "--out", "out"],
            vec!["stats", file],
            vec!["simulate", "--events", file, "--out", "out"],
            vec!["gen-dataset", "--preset", file, "--out", "out"],
            [&chance[..], &["--predictions", file]].concat(),
            [&chance[..], &["--method", "chance", "--ratings", file]].concat(),
            vec!["eval", "goals", "--method", "chance", "--events", file, "--out", "out"],
            #[cfg(feature = "serve")]
            vec!["study", "check", file],
        ];
        for arguments in commands {
            let mut command = phase(path);
            command.args(&arguments).stdout(Stdio::null()).stderr(Stdio::piped());
            let mut child = command.spawn().expect("it starts");
            let begun = Instant::now();
            while child.try_wait().expect("its state").is_none() {
                if begun.elapsed() > PATIENCE {
                    child.kill().expect("killed");
                    panic!("{arguments:?} waits");
                }
                thread::sleep(Duration::from_millis(20));
            }
            let output = child.wait_with_output().expect("its output");
            let told = text(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{arguments:?}: {told}");
            assert!(told.contains("is not a file") || told.contains("no preset"), "{arguments:?}: {told}");
        }
    }
}

#[test]
fn members_that_come_twice_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events(path, "events.json");
    let twice = |name: &str, value: &Value| {
        let text = value.to_string();
        // The first member once more, with its value.
        let member = text[1..].split(',').next().expect("a member");
        fs::write(path.join(name), format!("{{{member},{}", &text[1..])).expect("written");
    };
    twice("twice.json", &json!({ "format": "phase-events/1", "events": [recording("a")] }));
    let file = fs::read_to_string(path.join("twice.json")).expect("text");
    fs::write(path.join("twice.json"), file.replacen("\"alpha\":0", "\"alpha\":0,\"alpha\":1", 1))
        .expect("written");
    let preset: Value = serde_json::from_str(DEMO).expect("JSON");
    fs::write(path.join("preset.json"), preset.to_string().replacen('{', "{\"seed\":3,", 1))
        .expect("written");
    let relation = r#""relation": {"friendly": 1, "friendly": 0, "adversarial": 0, "neutral": 0}"#;
    let answer = format!(r#"{{"events": [{{"id": "a", "goals": [[], []], {relation}}}]}}"#);
    fs::write(path.join("answers.json"), answer).expect("written");
    let rated = r#"{"friendly": 1, "adversarial": 0, "neutral": 0}"#;
    let ratings = format!(r#"{{"format": "phase-ratings/1", "ratings": {{"a": {rated}, "a": {rated}}}}}"#);
    fs::write(path.join("ratings.json"), ratings).expect("written");
    let eval = ["eval", "goals", "--events", "events.json", "--out", "out"];
    for arguments in [
        vec!["stats", "twice.json"],
        vec!["gen-dataset", "--preset", "preset.json", "--out", "out"],
        [&eval[..], &["--predictions", "answers.json"]].concat(),
        [&eval[..], &["--method", "chance", "--ratings", "ratings.json"]].concat(),
    ] {
        let told = refuse(path, &arguments);
        assert!(told.contains("twice"), "{told}");
    }
}

#[test]
fn forecasts_of_other_steps_and_members_of_no_meaning_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let mut long = recording("a");
    for track in ["agents", "objects"] {
        for rows in long["trajectory"][track].as_array_mut().expect("tracks") {
            let rows = rows.as_array_mut().expect("rows");
            let last = rows[0].clone();
            rows.resize(41, last);
        }
    }
    let entities = 2 + long["trajectory"]["objects"].as_array().expect("objects").len();
    save(path, "events.json", &json!({ "format": "phase-events/1", "events": [long] }));
    let forecast = vec![vec![[8.0, 8.0]; 20]; entities];
    let answers = |event: Value, file: Value| {
        let mut answer = json!({ "id": "a", "forecast": forecast });
        answer.as_object_mut().expect("an object").append(&mut event.as_object().expect("members").clone());
        let mut answers = json!({ "events": [answer] });
        answers.as_object_mut().expect("an object").append(&mut file.as_object().expect("members").clone());
        save(path, "answers.json", &answers);
    };
    let eval =
        ["eval", "trajectories", "--events", "events.json", "--predictions", "answers.json", "--out", "out"];
    for (event, file, wanted) in [
        (json!({ "watched_steps": 10 }), json!({}), "watched_steps"),
        (json!({}), json!({ "watched_steps": 30 }), "watched_steps"),
        (json!({}), json!({ "predicted_steps": 10 }), "predicted_steps"),
        (json!({ "future": [] }), json!({}), "did you mean `futures`"),
        (json!({}), json!({ "comment": "" }), "comment"),
    ] {
        answers(event, file);
        let told = refuse(path, &eval);
        assert!(told.contains(wanted), "{told}");
    }
    answers(json!({ "watched_steps": 20, "_mine": 1 }), json!({ "watched_steps": 20, "_mine": 1 }));
    succeed(path, &eval);
    // Results are predictions.
    let again = [
        "eval",
        "trajectories",
        "--events",
        "events.json",
        "--predictions",
        "out/results.json",
        "--out",
        "again",
    ];
    succeed(path, &again);
}

#[test]
fn no_letter_of_others_steers_the_terminal() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let evil = "\u{1b}]0;title\u{7}\u{1b}[2J\u{9b}31m\u{202e}evil\u{2066}";
    let unseen =
        |letter: char| letter != '\n' && (letter.is_control() || "\u{202e}\u{2066}".contains(letter));
    dataset(path, "data");
    if fs::write(path.join("data").join(evil), "").is_err() {
        eprintln!("skipped: there are no such names here");
        return;
    }
    let mut scene = recording("a");
    scene[evil] = 1.into();
    scene[format!("{evil}{}", "x".repeat(100_000))] = 1.into();
    save(path, "events.json", &json!({ "format": "phase-events/1", "events": [scene] }));
    let mut preset: Value = serde_json::from_str(DEMO).expect("JSON");
    preset[evil] = 1.into();
    save(path, "preset.json", &preset);
    fs::create_dir(path.join("foreign")).expect("a folder");
    fs::write(path.join("foreign").join(evil), "").expect("written");
    let events = format!("{evil}.json");
    fs::write(path.join(&events), "{").expect("written");
    for arguments in [
        vec!["verify", "data"],
        vec!["verify", "data", "--json"],
        vec!["stats", "events.json"],
        vec!["stats", "events.json", "--verbose"],
        vec!["stats", &events],
        vec!["gen-dataset", "--preset", "preset.json", "--out", "out"],
        vec!["gen-dataset", "--out", "foreign"],
        vec![evil],
    ] {
        let output = run(path, &arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        for told in [text(&output.stdout), text(&output.stderr)] {
            assert!(!told.contains(unseen), "{arguments:?}: {told:?}");
            assert!(told.len() < 5000, "{arguments:?}: {} bytes", told.len());
        }
    }
}

#[test]
fn what_an_observer_makes_of_events_does_not_overwrite_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events(path, "a.observer.json");
    let before = fs::read(path.join("a.observer.json")).expect("there");
    for out in ["a.mp4", "a.observer.mp4", "."] {
        let told = crate::support::fail(path, &["render", "a.observer.json", "--observer", "--out", out]);
        assert!(told.contains("choose another --out"), "{told}");
    }
    assert!(fs::read(path.join("a.observer.json")).expect("there") == before);
}
