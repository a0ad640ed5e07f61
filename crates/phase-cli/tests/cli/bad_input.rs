//! For all invalid input: one sentence, exit code 2, nothing written.

use crate::support::{recording, refuse, run, text, tree, write_events};
use serde_json::{Value, json};
use std::fs;

#[test]
fn numbers_and_names_out_of_range() {
    let folder = tempfile::tempdir().expect("a folder");
    write_events(&folder.path().join("events.json"), &[recording("some-event-1"), recording("some-event-2")]);
    let simulate = ["simulate", "--events", "events.json", "--out", "out"];
    let cases: &[(&[&str], &[&str])] = &[
        (&["gen-dataset", "--events", "0"], &["--events", "'0'"]),
        (&["gen-dataset", "--events", "-3"], &["--events", "'-3'"]),
        (&["gen-dataset", "--no-video", "--size", "64"], &["--no-video", "--size"]),
        (&["gen-dataset", "--no-video", "--palette", "accessible"], &["--no-video", "--palette"]),
        (&["gen-dataset", "--no-video", "--frame-rate", "30"], &["--no-video", "--frame-rate"]),
        (&["gen-dataset", "--prior", "network-alone", "--simulations", "9"], &["--simulations", "search"]),
        (
            &["questions", "events.json", "--no-video", "--size", "64", "--out", "q"],
            &["--no-video", "--size"],
        ),
        (&["gen-dataset", "--events", "many"], &["--events", "many"]),
        (&["gen-dataset", "--jobs", "0"], &["--jobs", "'0'"]),
        (&["gen-dataset", "--jobs", "99999999"], &["--jobs", "99999999"]),
        (&["gen-dataset", "--seed", "1.5"], &["--seed", "1.5"]),
        (&["gen-dataset", "--seed", "99999999999999999999999"], &["--seed"]),
        (&["gen-dataset", "--preset", "nonsense"], &["--preset", "nonsense", "demo"]),
        (&["gen-dataset", "--simulations", "0"], &["--simulations", "'0'"]),
        (&["gen-dataset", "--particles", "0"], &["--particles", "'0'"]),
        (&["gen-dataset", "--max-steps", "0"], &["--max-steps", "'0'"]),
        (&["gen-dataset", "--engine", "box2d"], &["--engine", "'box2d'", "world", "forward"]),
        (&[&simulate[..], &["--engine", "World"]].concat(), &["--engine", "'World'", "world", "forward"]),
        (&["gen-dataset", "--evnts", "3"], &["--evnts", "--events"]),
        (&["simulate"], &["--events", "--out"]),
        (
            &[&simulate[..], &["--id", "some-event-3"]].concat(),
            &["events.json", "some-event-3", "some-event-1"],
        ),
        (&[&simulate[..], &["--jobs", "0"]].concat(), &["--jobs"]),
        (&["render"], &["FILE"]),
        (&["render", "events.json", "--belief", "7"], &["--belief", "'7'", "both"]),
        (&["render", "events.json", "--palette", "grey"], &["--palette", "'grey'", "accessible"]),
        (&["render", "events.json", "--belief", "0"], &["events.json", "some-event-1", "--belief"]),
        (&["render", "events.json", "--belief", "0", "--observer"], &["--belief", "--observer"]),
        (&["render", "events.json", "--seed", "3"], &["--observer"]),
        (&["render", "events.json", "--belief", "0", "--seed", "3"], &["--belief", "--seed"]),
        (&["render", "events.json", "--contact-sheet", "0"], &["--contact-sheet"]),
        (
            &["render", "events.json", "--contact-sheet", "2", "--frame-rate", "30"],
            &["--contact-sheet", "--frame-rate"],
        ),
        (&["render", "events.json", "--contact-sheet", "2", "--size", "64"], &["--contact-sheet", "--size"]),
        (&["render", "events.json", "--id", "other"], &["events.json", "\"other\""]),
        (&["render", "events.json", "--out", "one.mp4"], &["one.mp4", "2 events"]),
        (&["render", "events.json", "--out", "events.json"], &["events.json", "folder"]),
        (&["render", "events.json", "--out", "x.gif"], &["x.gif", ".gif cannot be written", ".mp4", ".png"]),
        (
            &["render", "events.json", "--out", "x.png"],
            &["x.png", ".png cannot be written", "--contact-sheet"],
        ),
        (&["render", "empty"], &["manifest.json", "event files"]),
        (&["new-scene", "--kind", "dancing"], &["dancing", "helping", "chasing"]),
        (&["new-scene", "--layout", "22"], &["--layout", "22"]),
        (&["new-scene", "--out", "events.json"], &["events.json exists"]),
        (&["completions", "cmd"], &["cmd", "bash"]),
        (&["man"], &["--out"]),
        (&["verify", ".", "--quiet", "--verbose"], &["--quiet", "--verbose"]),
        (&["verify", ".", "--resimulate-seed", "3"], &["--resimulate"]),
        (&["verify", ".", "--preset", "own.json"], &["--replay"]),
        (&["verify", ".", "--resimulate", "1", "--preset", "own.json"], &["--replay"]),
        (&["splits", ".", "--seed", "3"], &["--make"]),
        (&["splits", ".", "--splits", "events.json", "--seed", "3"], &["--splits", "--seed"]),
        (
            &["pack", ".", "--for", "qualtrics", "--address", "https://example.org/?a", "--out", "pack"],
            &["--address", "query"],
        ),
        (&["pack", ".", "--for", "qualtrics", "--address", "here", "--out", "pack"], &["--address", "https"]),
        (
            &["submit", "answers.json", "--events", ".", "--by", "N. N.", "--source", "A"],
            &["--source", "https"],
        ),
        (
            &["benchmark", "--data", ".", "--methods", "chance,still", "--minds", "published"],
            &["--minds", "none of the methods"],
        ),
        (&["dance"], &["dance"]),
    ];
    fs::create_dir(folder.path().join("empty")).expect("a folder");
    let before = tree(folder.path());
    for (arguments, expected) in cases {
        let sentence = refuse(folder.path(), arguments);
        for part in *expected {
            assert!(sentence.contains(part), "{arguments:?}: {part:?} is not in {sentence:?}");
        }
        // Looking for leftovers; `render` may have made its default folder.
        assert_eq!(tree(folder.path()), before, "{arguments:?}");
    }
}

#[test]
fn rubbish_instead_of_events() {
    let folder = tempfile::tempdir().expect("a folder");
    let changed = |pointer: &str, to: Value| {
        let mut event = recording("my-event");
        *event.pointer_mut(pointer).expect(pointer) = to;
        json!({"format": "phase-events/1", "events": [event]}).to_string().into_bytes()
    };
    let good = json!({"format": "phase-events/1", "events": [recording("my-event")]}).to_string();
    let with_nan = good.replacen("8.5", "NaN", 1);
    let cases: &[(Vec<u8>, &[&str])] = &[
        (b"".to_vec(), &["empty"]),
        (b"\x00\x00\x00\x20ftypisom\xff\xff\xff".to_vec(), &["not text"]),
        (b"\x89PNG\r\n\x1a\n".to_vec(), &["not text"]),
        (b"id;x;y\n".to_vec(), &["not JSON", "line 1"]),
        (good.as_bytes()[..good.len() - 40].to_vec(), &["truncated", "line 1"]),
        (with_nan.into_bytes(), &["NaN", "finite", "line 1"]),
        (good.replacen("8.5", "1e999", 1).into_bytes(), &["too large", "finite"]),
        (b"{\"format\": \"phase-events/1\", \"events\": []}".to_vec(), &["`events`", "at least one"]),
        (b"{\"format\": \"phase-dataset/1\"}".to_vec(), &["`format`", "phase-events/1"]),
        (b"{\"events\": []}".to_vec(), &["`format`", "missing"]),
        (b"[1, 2]".to_vec(), &["`format`", "array"]),
        (changed("/layout/base", json!(99)), &["my-event", "`layout.base`", "0 to 21"]),
        (changed("/agents/0/size_level", json!(-1)), &["my-event", "`agents[0].size_level`", "-1"]),
        (
            changed("/trajectory/agents/0/0/0", json!(2.0)),
            &["my-event", "`trajectory.agents[0][0]`", "arena"],
        ),
        (
            changed("/trajectory/agents/0/0/0", json!(null)),
            &["my-event", "`trajectory.agents[0][0][0]`", "null"],
        ),
        (changed("/agents/0/goal/landmark", json!(9)), &["my-event", "agents[0].goal.landmark", "not 9"]),
        (
            changed(
                "/agents/0/goal",
                json!({"kind": "object_on_landmark", "object": 1, "landmark": 0, "sign": 1}),
            ),
            &["my-event", "agents[0].goal", "object 1"],
        ),
        (changed("/id", json!("a/b")), &["`id`", "a/b"]),
        (changed("/id", json!("summary")), &["summary", "`id`"]),
    ];
    for (bytes, expected) in cases {
        fs::write(folder.path().join("bad.json"), bytes).expect("written");
        let before = tree(folder.path());
        let sentence = refuse(folder.path(), &["simulate", "--events", "bad.json", "--out", "out"]);
        assert!(sentence.contains("bad.json"), "{sentence}");
        for part in *expected {
            assert!(sentence.contains(part), "{part:?} is not in {sentence:?}");
        }
        assert!(!folder.path().join("out").exists(), "{sentence}");
        if !sentence.contains("summary") {
            refuse(folder.path(), &["render", "bad.json", "--out", "out"]);
            assert!(!folder.path().join("out").exists(), "{sentence}");
        }
        assert_eq!(tree(folder.path()), before, "{sentence}");
    }
    fs::create_dir(folder.path().join("empty")).expect("a folder");
    // A folder stands for all of its files.
    for (path, part) in [("missing.json", "no such file"), ("empty", "folder"), (".", "event summary")] {
        let sentence = refuse(folder.path(), &["simulate", "--events", path, "--out", "out"]);
        assert!(sentence.contains(part), "{sentence}");
    }
}

#[test]
fn output_folders_that_will_not_do() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    write_events(&path.join("events.json"), &[recording("my-event")]);
    fs::create_dir(path.join("someones")).expect("a folder");
    fs::write(path.join("someones").join("thesis.tex"), "years of work").expect("written");
    let before = tree(path);
    let cases = [
        ("someones", "thesis.tex"),
        ("events.json", "is a file"),
        ("events.json/below", "cannot create the folder"),
        // Folders cannot be created here, not even by root.
        #[cfg(target_os = "linux")]
        ("/proc/phase", "cannot create the folder"),
    ];
    for (out, part) in cases {
        for command in [&["gen-dataset"][..], &["simulate", "--events", "events.json"]] {
            let sentence = refuse(path, &[command, &["--out", out]].concat());
            assert!(sentence.contains(out) && sentence.contains(part), "{sentence}");
            assert_eq!(tree(path), before, "{sentence}");
        }
    }
}

#[test]
fn help_is_no_error() {
    let folder = tempfile::tempdir().expect("a folder");
    for arguments in [&["--help"][..], &["gen-dataset", "--help"], &["--version"]] {
        let output = run(folder.path(), arguments);
        assert!(output.status.success());
        assert!(!output.stdout.is_empty());
    }
    let output = run(folder.path(), &[]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("gen-dataset"));
}
