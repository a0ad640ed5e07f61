//! `verify`, on a dataset of agents that searched little.

use crate::support::{QUICK, refuse, run, succeed, text};
use phase_dataset::manifest::Manifest;
use phase_files::checksum::FileEntry;
use std::{fs, path::Path};

#[test]
fn problems_are_told_one_a_line_with_exit_code_2() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    succeed(path, &[&["gen-dataset", "--events", "2", "--out", "out"], &QUICK[..]].concat());
    let digest = FileEntry::of(&path.join("out"), "manifest.json").expect("there").sha256;
    let whole = format!("all 2 events are whole\nSHA-256 of manifest.json: {digest}");
    assert_eq!(succeed(path, &["verify", "out"]), format!("{whole}\n"));
    assert_eq!(succeed(path, &["verify", "out", "--digest", &digest]), format!("{whole}, as expected\n"));
    let line = fs::read_to_string(path.join("out/manifest.sha256")).expect("a digest");
    assert_eq!(line, format!("{digest}  manifest.json\n"));
    let found = problems(path, &["--digest", &"0".repeat(64)]);
    assert_eq!(found, ["out/manifest.json: differs from the digest that was given"]);

    fs::remove_file(path.join("out/videos/demo-0001.mp4")).expect("removed");
    fs::write(path.join("out/notes.txt"), "mine").expect("written");
    let output = run(path, &["verify", "out"]);
    assert_eq!(output.status.code(), Some(2));
    let told = text(&output.stderr);
    let lines: Vec<&str> = told.lines().collect();
    assert_eq!(
        lines,
        [
            "verifying 2 events",
            "out/videos/demo-0001.mp4: cannot be read: no such file or directory",
            "out/notes.txt: is not in the manifest",
            "error: out: 2 problem(s)",
        ]
    );
    assert!(output.stdout.is_empty());
    for jobs in ["1", "3"] {
        let again = run(path, &["verify", "out", "--jobs", jobs]);
        assert_eq!((again.status.code(), text(&again.stderr)), (Some(2), told.clone()), "--jobs {jobs}");
    }
}

#[test]
fn what_is_no_finished_dataset_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    assert!(refuse(path, &["verify", "nowhere"]).contains("nowhere: holds no manifest.json"));
    fs::create_dir(path.join("empty")).expect("made");
    assert!(refuse(path, &["verify", "empty"]).contains("empty: holds no manifest.json"));

    fs::create_dir(path.join("begun")).expect("made");
    fs::write(path.join("begun/.phase-run.json"), r#"{"format": "phase-run/2"}"#).expect("written");
    assert!(refuse(path, &["verify", "begun"]).contains("begun: is unfinished"));

    fs::create_dir(path.join("cut")).expect("made");
    fs::write(path.join("cut/manifest.json"), "{\"format\":").expect("written");
    assert!(refuse(path, &["verify", "cut"]).contains("cut/manifest.json: is truncated"));
}

/// Puts another text into a file of a dataset, and the checksums right.
fn edit(folder: &Path, name: &str, from: &str, to: &str) {
    let text = fs::read_to_string(folder.join(name)).expect("a file");
    let changed = text.replacen(from, to, 1);
    assert_ne!(text, changed, "{from}");
    let before = FileEntry::of(folder, name).expect("there");
    fs::write(folder.join(name), changed).expect("written");
    let now = FileEntry::of(folder, name).expect("there");
    let croissant = folder.join("croissant.json");
    let text = fs::read_to_string(&croissant).expect("a file");
    fs::write(&croissant, text.replace(&before.sha256, &now.sha256)).expect("written");
    let mut manifest = Manifest::read(&folder.join("manifest.json")).expect("a manifest");
    for entry in &mut manifest.files {
        *entry = FileEntry::of(folder, entry.path.as_str()).expect("there");
    }
    manifest.write(folder).expect("written");
}

/// The problems that `verify` names.
fn problems(folder: &Path, arguments: &[&str]) -> Vec<String> {
    let output = run(folder, &[&["verify", "out", "--quiet"], arguments].concat());
    let told = text(&output.stderr);
    assert!(output.status.code() == Some(if told.is_empty() { 0 } else { 2 }), "{told}");
    told.lines().filter(|line| !line.starts_with("error: ")).map(String::from).collect()
}

#[test]
fn what_files_agree_about_is_derived_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let preset = r#"{"format": "phase-preset/3", "name": "own", "seed": 3, "layouts": {"all": [0, 4, 8]},
        "groups": [{"variant": "chase", "split": "train", "layouts": "all", "events": 1},
                   {"variant": "carry", "split": "test", "layouts": "all", "events": 1}]}"#;
    fs::write(path.join("own.json"), preset).expect("written");
    let make = [&["gen-dataset", "--preset", "own.json", "--out", "out"], &QUICK[..]].concat();
    succeed(path, &make);
    let preset = ["--preset", "own.json"];
    let replay = [&["--replay"][..], &preset].concat();
    let both = [&["--replay", "--resimulate", "all"][..], &preset].concat();
    assert_eq!(problems(path, &both), [""; 0]);
    let out = path.join("out");

    // The card may name any file: it is not opened.
    let found = problems(path, &["--replay"]);
    assert!(
        found.len() == 1 && found[0].contains("give the file of its preset, \"own.json\", with --preset"),
        "{found:?}"
    );

    // The card names the command; with another seed it makes another dataset.
    edit(&out, "README.md", "--seed 3 ", "--seed 4 ");
    assert_eq!(problems(path, &[]), [""; 0]);
    let found = problems(path, &replay);
    assert!(
        found.len() == 1
            && found[0].contains("README.md: differs from the manifest, which has seed 3 instead of 4"),
        "{found:?}"
    );
    edit(&out, "README.md", "--seed 4 ", "--seed 3 ");
    assert_eq!(problems(path, &both), [""; 0]);

    edit(&out, "index.html", "<title>", "<Title>");
    assert_eq!(problems(path, &[]), [""; 0]);
    let found = problems(path, &replay);
    assert_eq!(found.first().map(String::as_str), Some("out/index.html: differs from what the events give"));
}

/// No command opens a file that a manifest names outside of its folder, or waits for a pipe in place of a
/// manifest.
#[test]
fn what_a_manifest_names_lies_in_its_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    succeed(path, &[&["gen-dataset", "--events", "1", "--no-video", "--out", "out"], &QUICK[..]].concat());
    let manifest = path.join("out/manifest.json");
    let text = fs::read_to_string(&manifest).expect("a manifest");
    for (from, to, rule) in [
        ("events/demo-0000.json", "/etc/passwd", "the path \"/etc/passwd\" must be a relative path"),
        ("events/demo-0000.json", "../../secret", "the path \"../../secret\" must be a relative path"),
        ("\"id\": \"demo-0000\"", "\"id\": \"../x\"", "the id \"../x\" must be 1 to 100 letters"),
    ] {
        fs::write(&manifest, text.replace(from, to)).expect("written");
        for command in [
            &["verify", "out"][..],
            &["render", "out", "--out", "video.mp4"],
            &["eval", "goals", "--method", "simple", "--events", "out"],
            &["stats", "out"],
            &["splits", "out"],
            &["export", "out", "--out", "tar"],
            &["gen-dataset", "--events", "1", "--no-video", "--out", "out"],
            #[cfg(feature = "networks")]
            &["train", "arg", "--data", "out", "--out", "weights"],
        ] {
            let told = refuse(path, command);
            assert!(told.contains("out/manifest.json: ") && told.contains(rule), "{told}");
        }
    }
    fs::remove_file(&manifest).expect("removed");
    if cfg!(unix) {
        let made = std::process::Command::new("mkfifo").arg(&manifest).status();
        assert!(made.expect("mkfifo").success());
        assert!(refuse(path, &["verify", "out"]).contains("out/manifest.json: is not a file"));
    }
}
