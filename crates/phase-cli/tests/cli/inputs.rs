//! Inputs stay as they are, whatever a file of results is named, and are what they say.

use crate::support::{fail, recording, refuse, run, succeed, text, tree, write_events};
use serde_json::{Value, json};
use std::{fs, path::Path};

/// Six events of eight steps, with videos if asked for.
fn generate(path: &Path, out: &str, seed: &str, videos: bool) {
    let effort = ["--max-steps", "8", "--simulations", "10", "--particles", "4"];
    let form = if videos { ["--size", "64"].as_slice() } else { &["--no-video"] };
    let made = ["gen-dataset", "--events", "6", "--seed", seed, "--out", out];
    succeed(path, &[&made[..], &effort, form].concat());
}

#[test]
fn no_output_replaces_an_input() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "data", "1", false);
    write_events(&path.join("in.json"), &[recording("one"), recording("two")]);
    fs::write(path.join("t.csv"), "time,body,x,y\n0,a,1,1\n").expect("written");
    let before = tree(path);
    let eval = ["eval", "goals", "--method", "chance", "--out", "scores", "--events"];
    let cases: &[&[&str]] = &[
        &["in.json", "--json", "in.json"],
        &["in.json", "--json", "./in.json"],
        &["data", "--json", "data/manifest.json"],
        &["data", "--json", "data/new.json"],
    ];
    for &case in cases {
        let told = refuse(path, &[&eval[..], case].concat());
        let rules = ["is an input file or in an input folder", "would lie in the dataset"];
        assert!(told.contains("--json") && rules.iter().any(|rule| told.contains(rule)), "{told}");
    }
    for case in [
        &["aoi", "in.json", "--out", "in.json"][..],
        &["splits", "in.json", "--make", "in.json"],
        &["splits", "data", "--make", "data/manifest.json"],
        &["track", "t.csv", "--out", "t.csv"],
        &["benchmark", "--data", "data", "--methods", "chance", "--figures", "data/manifest.json"],
    ] {
        let told = refuse(path, case);
        let rules = ["is an input file or in an input folder", "would lie in the dataset"];
        assert!(rules.iter().any(|rule| told.contains(rule)), "{case:?}: {told}");
    }
    assert_eq!(tree(path), before, "nothing was written");
}

/// A dataset holds what its manifest says, and nothing else.
#[test]
fn no_result_lies_in_a_dataset() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "data", "1", true);
    write_events(&path.join("in.json"), &[recording("one")]);
    fs::write(path.join("t.csv"), "id,x\na,1\nb,2\nc,4\n").expect("written");
    fs::create_dir(path.join("web")).expect("a folder");
    fs::write(path.join("web/manifest.json"), r#"{ "name": "a page" }"#).expect("written");
    let before = tree(path);
    for case in [
        &["stats", "in.json", "--out", "data/more"][..],
        &["stats", "in.json", "--out", "data"],
        &["rdm", "t.csv", "--out", "data"],
        &["rdm", "t.csv", "--out", "data/events/more"],
        &["match", "in.json", "--out", "data"],
        &["render", "data", "--out", "data/videos/more"],
        &["simulate", "--events", "in.json", "--no-video", "--out", "data/events/../more"],
        &["pack", "data", "--for", "psychopy", "--out", "data/pack"],
        &["eval", "goals", "--method", "chance", "--events", "in.json", "--out", "data/scores"],
        &["gen-dataset", "--events", "1", "--no-video", "--out", "data/videos/more"],
    ] {
        let told = refuse(path, case);
        assert!(told.contains("--out data") && told.contains("would lie in the dataset"), "{case:?}: {told}");
    }
    assert_eq!(tree(path), before, "nothing was written");
    succeed(&path.join("data"), &["verify", ".", "--json"]);
    let eval = ["eval", "goals", "--method", "chance", "--events", ".", "--out", "../scores", "--json"];
    succeed(&path.join("data"), &eval);
    fs::remove_dir_all(path.join("scores")).expect("removed");
    assert_eq!(tree(path), before, "results on standard output write no file");
    // Other programs have files of the manifest's name.
    succeed(path, &["rdm", "t.csv", "--out", "web/matrices"]);
}

#[test]
fn names_of_matrices_are_names_of_different_files_on_every_system() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    fs::write(path.join("t.csv"), "id,x\na,1\nb,2\nc,4\n").expect("written");
    let told = refuse(path, &["rdm", "A=t.csv", "a=t.csv", "--out", "matrices"]);
    assert!(told.contains("\"a\": names of matrices must be different"), "{told}");
    fs::write(path.join("t.csv"), "id,x\na,1\nb\nc,4\n").expect("written");
    let told = refuse(path, &["rdm", "t.csv", "--out", "matrices"]);
    assert!(told.contains("t.csv: line 3: has 1 cell, the lines before have 2"), "{told}");
}

#[test]
fn videos_are_those_of_the_manifest() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "data", "1", true);
    fs::write(path.join("data/videos/demo-0003.mp4"), "no video").expect("written");
    for case in [
        &["pack", "data", "--for", "psychopy", "--out", "packed"][..],
        &["study", "new", "--experiment", "relations", "--videos", "data", "--out", "study.json"],
    ] {
        let told = refuse(path, case);
        assert!(told.contains("demo-0003.mp4: differs in size from what its manifest says"), "{told}");
    }
    succeed(path, &["pack", "data", "--id", "demo-0001", "--for", "psychopy", "--out", "packed"]);
}

#[test]
fn a_preset_that_cannot_be_read_is_no_fault_of_the_dataset() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "data", "1", false);
    let told = refuse(path, &["verify", "-q", "data", "--replay", "--preset", "nope"]);
    assert!(told.contains("error: nope: cannot be read"), "{told}");
}

#[test]
fn settings_that_cannot_be_read_are_named_with_their_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "data", "1", false);
    let text = fs::read_to_string(path.join("data/events/demo-0000.json")).expect("an event");
    let mut event: Value = serde_json::from_str(&text).expect("JSON");
    let member = event.pointer_mut("/events/0/settings/minds/particles").expect("a setting");
    *member = json!("many");
    fs::write(path.join("odd.json"), event.to_string()).expect("written");
    let eval = ["eval", "beliefs", "-q", "--method", "last-seen", "--events", "odd.json", "--out", "scores"];
    let told = refuse(path, &eval);
    assert!(told.contains("odd.json: event demo-0000") && told.contains("particles"), "{told}");
}

#[test]
fn a_place_that_cannot_be_written_is_refused_before_the_work() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    write_events(&path.join("in.json"), &[recording("one")]);
    fs::create_dir(path.join("there")).expect("a folder");
    for (out, rule) in [("nowhere/a.csv", "its folder does not exist"), ("there", "is a folder")] {
        let told = refuse(path, &["aoi", "in.json", "--out", out]);
        assert!(told.contains(rule), "{told}");
    }
    let told = refuse(path, &["clip", "in.json", "--seconds", "1", "--size", "65", "--out", "clips"]);
    assert!(told.contains("--size: must be even for videos, not 65"), "{told}");
}

#[test]
fn names_of_clips_are_names_of_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    write_events(&path.join("in.json"), &[recording("one"), recording("two")]);
    succeed(path, &["clip", "in.json", "--seconds", "1", "--size", "64", "--out", "clips"]);
    let file = path.join("clips/clips.json");
    let list: Value = serde_json::from_slice(&fs::read(&file).expect("a list")).expect("JSON");
    let other = list["clips"][1]["id"].as_str().expect("a name").to_owned();
    for (id, rule) in [("../../evil", "clips: id must be"), ("", "clips: id must be"), (&other, "two clips")]
    {
        let mut wrong = list.clone();
        wrong["clips"][0]["id"] = json!(id);
        fs::write(&file, wrong.to_string()).expect("written");
        let told = fail(path, &["pack", "clips", "--for", "psychopy", "--out", "packed"]);
        assert!(told.contains("clips.json") && told.contains(rule), "{id:?}: {told}");
        assert!(!path.join("packed").exists(), "{id:?}");
    }
}

#[test]
fn lists_of_clips_are_those_that_clip_writes() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    write_events(&path.join("in.json"), &[recording("one"), recording("two")]);
    let clip = ["clip", "in.json", "--seconds", "1", "--size", "64", "--as", "mp4,gif", "--out", "clips"];
    succeed(path, &clip);
    succeed(path, &["pack", "clips", "--for", "psychopy", "--out", "packed"]);
    let file = path.join("clips/clips.json");
    let text = fs::read_to_string(&file).expect("a list");
    let list: Value = serde_json::from_str(&text).expect("JSON");
    for (pointer, wrong, told) in [
        ("/format", json!("phase-clips/99"), "phase-clips/1"),
        ("/clips/0/kind", json!("=HYPERLINK(1)"), "clips[0].kind"),
        ("/clips/0/relation", json!("foo"), "clips[0].relation"),
        ("/clips/0/steps", json!(0), "steps must be at least 1"),
        ("/clips/0/first_step", json!(-3), "clips[0].first_step"),
        ("/clips/0/video", json!("clips.json"), "video must be"),
        ("/clips/0/video", list["clips"][1]["video"].clone(), "video must be"),
        ("/clips", json!([]), "there is none"),
    ] {
        let mut edited = list.clone();
        *edited.pointer_mut(pointer).expect(pointer) = wrong;
        fs::write(&file, edited.to_string()).expect("written");
        let said = fail(path, &["pack", "clips", "--for", "psychopy", "--out", "other"]);
        assert!(said.contains("clips.json") && said.contains(told), "{pointer}: {said}");
    }
    fs::write(&file, text).expect("written");
    fs::remove_file(path.join("clips").join(list["clips"][0]["gif"].as_str().expect("a file")))
        .expect("removed");
    let said = fail(path, &clip);
    assert!(said.contains("which is gone"), "{said}");
}

#[test]
fn raw_data_of_participants_stay() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let trial = json!({
        "trial_type": "phase-rating", "form": "relation", "event": "one",
        "response": { "relation": "friendly" },
    });
    let raw = json!([trial]).to_string();
    fs::write(path.join("raw.json"), &raw).expect("written");
    let before = tree(path);
    let said = run(path, &["study", "ratings", "raw.json", "--out", "raw.json"]);
    assert_eq!(said.status.code(), Some(2), "{}", text(&said.stderr));
    let said = run(path, &["study", "ratings", "raw.json", "./raw.json", "--out", "ratings.json"]);
    assert_eq!(said.status.code(), Some(2), "{}", text(&said.stderr));
    fs::write(path.join("t.csv"), "id,x,y\na,1,n/a\nb,2,3\nc,4,5\n").expect("written");
    let told = refuse(path, &["rdm", "t.csv", "--out", "."]);
    assert!(told.contains("has the input t.csv"), "{told}");
    let told = refuse(path, &["rdm", "t.csv", "--out", "matrices"]);
    assert!(told.contains("t.csv: row 1: y is missing"), "{told}");
    succeed(path, &["rdm", "t.csv:x", "--out", "matrices"]);
    fs::remove_file(path.join("t.csv")).expect("removed");
    fs::remove_dir_all(path.join("matrices")).expect("removed");
    assert_eq!(tree(path), before);
}

#[test]
fn questions_are_sealed_with_the_events_that_they_are_about() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "one", "11259375999999999999", false);
    generate(path, "other", "11259375999999999998", false);
    let asked = run(path, &["questions", "other", "--no-video", "--out", "asked"]);
    if !asked.status.success() {
        assert!(text(&asked.stderr).contains("no question can be asked"), "{}", text(&asked.stderr));
        // Questions of another program, about the same names.
        fs::create_dir_all(path.join("asked")).expect("a folder");
        fs::write(path.join("asked/questions.jsonl"), "").expect("written");
        fs::write(path.join("asked/questions.json"), json!({ "run": { "events": ["x"] } }).to_string())
            .expect("written");
    }
    let told = fail(path, &["seal", "one", "--questions", "asked", "--out", "public"]);
    assert!(told.contains("questions.json: is not about the events of one"), "{told}");
}

#[test]
fn a_part_of_events_that_are_not_divided_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "data", "1", false);
    let told = fail(path, &["questions", "data", "--split", "test", "--no-video", "--out", "asked"]);
    assert!(told.contains("data: has no test events: it is not divided"), "{told}");
    assert!(!path.join("asked").exists(), "the folder is not claimed");
}

/// The legend of the picture is as wide as the arena.
#[test]
fn beliefs_are_drawn_at_the_smallest_size() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "data", "1", false);
    let render =
        ["render", "data", "--id", "demo-0000", "--belief", "0", "--size", "64", "--out", "small.mp4"];
    succeed(path, &render);
    assert!(path.join("small.mp4").is_file());
}
