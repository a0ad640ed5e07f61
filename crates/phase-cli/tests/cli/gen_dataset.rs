//! `gen-dataset`, with agents that search little.

use crate::support::{QUICK, refuse, run, succeed, text, tree};
use phase_dataset::manifest::Manifest;
use phase_event::{Recording, parse};
use std::{fs, path::Path};

fn generate<'a>(out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["gen-dataset", "--events", "3", "--out", out], &QUICK[..], more].concat()
}

/// The same seed, one job and two: the same bytes in every file.
#[test]
fn results_do_not_depend_on_the_number_of_jobs() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    succeed(path, &generate("one", &["--jobs", "1"]));
    succeed(path, &generate("two", &["--jobs", "2"]));
    let (one, two) = (tree(&path.join("one")), tree(&path.join("two")));
    assert_eq!(one.len(), 7 + 2 * 3);
    assert!(
        one == two,
        "{:?}",
        one.iter().filter(|(name, bytes)| two.get(*name) != Some(bytes)).map(|it| it.0).collect::<Vec<_>>()
    );
    succeed(path, &generate("three", &["--seed", "2"]));
    let other = tree(&path.join("three"));
    let event = Path::new("events/demo-0000.json");
    assert!(one[event] != other[event], "another seed makes another event");
}

#[test]
fn the_folder_holds_what_it_promises() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out");
    let told = succeed(folder.path(), &generate("out", &[]));
    assert!(told.contains("out") && told.contains("index.html"), "{told}");
    let manifest = Manifest::read(&out.join("manifest.json")).expect("a manifest");
    manifest.verify(&out).expect("every checksum fits");
    let kinds: Vec<&str> = manifest.events.iter().map(|event| event.kind.name()).collect();
    assert_eq!(kinds, ["helping", "hindering", "chasing"]);
    for entry in &manifest.events {
        let bytes = fs::read(entry.event.place(&out)).expect("an event file");
        let events: Vec<Recording> = parse(&bytes).expect("a good event file");
        assert_eq!(events.len(), 1);
        let simulation = events[0].simulation.as_ref().expect("a simulation");
        assert_eq!((events[0].id.as_str(), simulation.event.seed), (entry.id.as_str(), entry.seed));
        assert_eq!(simulation.event.steps.len(), 4);
        events[0].scene.validate_without_overlap().expect("nothing overlaps at the start");
        let video = entry.video.as_ref().expect("a video");
        let video = fs::read(video.place(&out)).expect("its file");
        assert_eq!(&video[4..8], b"ftyp");
    }
    let page = fs::read_to_string(out.join("index.html")).expect("a page");
    assert_eq!(page.matches("<video").count(), 3);
    let card = fs::read_to_string(out.join("README.md")).expect("a card");
    assert!(card.starts_with("---\n") && card.contains("path: data/train-*.parquet"), "{card}");
    assert!(card.contains("--events 3") && card.contains("--simulations 20"), "{card}");
}

/// Without videos, everything else is the same.
#[test]
fn videos_can_be_left_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    succeed(path, &generate("with", &[]));
    let told = succeed(path, &generate("without", &["--no-video"]));
    assert!(!told.contains("index.html"), "{told}");
    let (with, without) = (tree(&path.join("with")), tree(&path.join("without")));
    let left_out = |name: &&Path| name.starts_with("videos") || name.ends_with("index.html");
    let names: Vec<&Path> = with.keys().map(AsRef::as_ref).filter(|name| !left_out(name)).collect();
    assert_eq!(without.keys().map(AsRef::as_ref).collect::<Vec<&Path>>(), names);
    assert!(names.iter().filter(|name| name.starts_with("events")).all(|&name| with[name] == without[name]));
    let card = text(&without[Path::new("README.md")]);
    assert!(card.contains("--no-video") && !card.contains("index.html"), "{card}");
    succeed(path, &["verify", "without"]);
    assert!(succeed(path, &generate("without", &["--no-video"])).contains("already"));
    let sentence = refuse(path, &generate("without", &[]));
    assert!(sentence.contains("videos"), "{sentence}");

    succeed(path, &generate("one", &["--no-video", "--shard", "1/2"]));
    succeed(path, &generate("two", &["--no-video", "--shard", "2/2"]));
    succeed(path, &["merge", "one", "two", "--out", "merged"]);
    assert!(tree(&path.join("merged")) == without);
}

#[test]
fn a_finished_dataset_is_left_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    succeed(path, &generate("out", &[]));
    let before = tree(&path.join("out"));
    let told = succeed(path, &generate("out", &["--jobs", "2"]));
    assert!(told.contains("already"), "{told}");
    assert!(tree(&path.join("out")) == before);

    let sentence = refuse(path, &generate("out", &["--seed", "5"]));
    assert!(sentence.contains("out: ") && sentence.contains("seed 1 instead of 5"), "{sentence}");
    let sentence = refuse(path, &["simulate", "--events", "out/events/demo-0000.json", "--out", "out"]);
    assert!(sentence.contains("contains other files"), "{sentence}");
    assert!(tree(&path.join("out")) == before);

    let video = path.join("out/videos/demo-0001.mp4");
    fs::write(&video, "spoilt").expect("written");
    let sentence = refuse(path, &generate("out", &[]));
    assert!(sentence.contains("demo-0001.mp4") && sentence.contains("size"), "{sentence}");
    assert_eq!(fs::read_to_string(&video).expect("still there"), "spoilt");
}

#[test]
fn the_engine_is_recorded_and_kept_to() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    succeed(path, &generate("world", &[]));
    succeed(path, &generate("forward", &["--engine", "forward"]));
    let (world, forward) = (tree(&path.join("world")), tree(&path.join("forward")));
    let event = Path::new("events/demo-0000.json");
    assert!(world[event] != forward[event], "another engine makes another event");
    let recorded = text(&forward[event]);
    assert!(recorded.contains(r#""engine":"forward""#), "{recorded}");
    assert!(text(&forward[Path::new("README.md")]).contains("--engine forward"));

    let sentence = refuse(path, &generate("forward", &[]));
    assert!(
        sentence.contains(r#"a finished run of another kind (settings.engine "forward" instead of "world")"#)
    );
    assert!(tree(&path.join("forward")) == forward);

    // A manifest that names no engine is that of another run.
    let world = path.join("world");
    let mut manifest = Manifest::read(&world.join("manifest.json")).expect("a manifest");
    manifest.settings.as_object_mut().expect("settings").remove("engine").expect("an engine");
    manifest.write(&world).expect("written");
    for engine in ["world", "forward"] {
        let sentence = refuse(path, &generate("world", &["--engine", engine]));
        assert!(sentence.contains("settings.engine null instead of"), "{sentence}");
    }
}

#[test]
fn without_a_folder_it_names_its_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let arguments = [&["gen-dataset", "--events", "1", "--seed", "9"], &QUICK[..]].concat();
    let output = run(folder.path(), &arguments);
    assert!(output.status.success());
    assert!(text(&output.stdout).contains("out/demo-seed9-1"), "{}", text(&output.stdout));
    assert!(text(&output.stderr).contains("1/1 demo-0000 helping"), "{}", text(&output.stderr));
    assert!(folder.path().join("out/demo-seed9-1/index.html").is_file());
    let told = succeed(folder.path(), &[&arguments[..], &["--engine", "forward"]].concat());
    assert!(told.contains("out/demo-seed9-1-forward"), "{told}");
}

/// Writes a preset of one event whose member `minds` is this JSON.
fn write_preset(path: &Path, minds: &str) {
    let text = format!(
        r#"{{"format": "phase-preset/3", "name": "own", "seed": 3, "minds": {minds}, "layouts": {{"all": [0]}},
        "groups": [{{"variant": "places", "layouts": "all", "events": 1}}]}}"#
    );
    fs::write(path.join("own.json"), text).expect("written");
}

/// A preset's minds replace the defaults, and options replace those of the preset.
#[test]
fn a_preset_can_say_how_minds_search() {
    const MAKE: [&str; 6] = ["gen-dataset", "--preset", "own.json", "--no-video", "--max-steps", "3"];
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let minds = |out: &str, more: &[&str]| {
        succeed(path, &[&MAKE, &["--out", out][..], more].concat());
        let manifest = Manifest::read(&path.join(out).join("manifest.json")).expect("a manifest");
        let minds = &manifest.settings["minds"];
        ["kind", "prior", "simulations"].map(|name| minds[name].to_string().replace('"', ""))
    };
    write_preset(path, r#"{"prior": "network", "simulations": 7}"#);
    assert_eq!(minds("given", &[]), ["phase", "network", "7"]);
    // Files leave out `habits`, the default.
    assert_eq!(minds("asked", &["--prior", "habits"]), ["phase", "null", "7"]);
    let published = minds("published", &["--minds", "published", "--simulations", "5"]);
    assert_eq!(published, ["published", "null", "5"]);

    for (given, rule) in [
        (
            r#"{"priors": "network"}"#,
            "own.json: is not a complete preset: in `minds`, field `priors` is no parameter of",
        ),
        (r#"{"simulations": 0}"#, "simulations"),
        ("[]", "parameters of minds must be an object"),
    ] {
        write_preset(path, given);
        let sentence = refuse(path, &[&MAKE, &["--out", "refused"][..]].concat());
        assert!(sentence.contains(rule), "{sentence}");
    }
}
