//! Whole datasets, and damaged ones.

use phase_dataset::{
    croissant::croissant,
    manifest::{Manifest, event_path, video_path},
    overview::Overview,
    verify::{Check, verify, verify_with, work},
};
use phase_files::{atomic, checksum::FileEntry};
use std::{
    fs,
    path::Path,
    sync::atomic::{AtomicUsize, Ordering::Relaxed},
};

const DATA: &str = "data/train-00000-of-00001.parquet";

/// A whole dataset of three events.
pub(crate) fn dataset(folder: &Path) -> Manifest {
    let mut manifest = crate::manifest::dataset(folder, "made-up-0");
    manifest.events = crate::parquet::events(folder, &[2, 3, 1]);
    manifest.files = crate::parquet::export(folder, &manifest.events).expect("written");
    for name in ["index.html", "README.md", "croissant.json"] {
        let text =
            if name == "croissant.json" { croissant(&Overview::of(&manifest), "about") } else { name.into() };
        describe(folder, &mut manifest, name, &text);
    }
    manifest.write(folder).expect("written");
    manifest
}

fn describe(folder: &Path, manifest: &mut Manifest, name: &str, text: &str) {
    atomic::write(&folder.join(name), text.as_bytes()).expect("written");
    manifest.files.push(FileEntry::of(folder, name).expect("there"));
}

/// What is found wrong with a folder that has this manifest.
fn sentences(folder: &Path, manifest: &Manifest) -> Vec<String> {
    manifest.write(folder).expect("written");
    found(folder, manifest)
}

pub(crate) fn found(folder: &Path, manifest: &Manifest) -> Vec<String> {
    let problems = verify(folder, manifest);
    problems
        .iter()
        .map(|problem| problem.to_string().replace(&format!("{}/", folder.display()), ""))
        .collect()
}

/// The manifest's entry of a file, whose checksum is to be updated.
fn renew(folder: &Path, manifest: &mut Manifest, path: &str) {
    let of_events =
        manifest.events.iter_mut().flat_map(|event| [Some(&mut event.event), event.video.as_mut()]).flatten();
    for entry in of_events.chain(&mut manifest.files).filter(|entry| *entry.path.as_str() == *path) {
        *entry = FileEntry::of(folder, path).expect("there");
    }
}

#[test]
fn a_whole_dataset_has_no_problem() {
    let folder = tempfile::tempdir().expect("a folder");
    let manifest = dataset(folder.path());
    assert_eq!(sentences(folder.path(), &manifest), [""; 0]);
}

/// Each damage is named in one sentence with its file.
#[test]
fn damage_is_named() {
    type Damage = fn(&Path);
    let event = event_path("made-up-1");
    let video = video_path("made-up-1");
    let cases: [(&str, Damage, &str, &str); 9] = [
        (
            "missing",
            |root| fs::remove_file(root.join(video_path("made-up-1"))).expect("gone"),
            &video,
            "cannot be read",
        ),
        ("cut", |root| fs::write(root.join(event_path("made-up-1")), "{").expect("written"), &event, "size"),
        ("empty", |root| fs::write(root.join(DATA), "").expect("written"), DATA, "size"),
        (
            "same size",
            |root| fs::write(root.join("README.md"), "readme.md").expect("written"),
            "README.md",
            "checksum",
        ),
        (
            "extra",
            |root| fs::write(root.join("videos/more.mp4"), "").expect("written"),
            "videos/more.mp4",
            "not in the manifest",
        ),
        (
            "leftover",
            |root| fs::write(root.join(".phase-lock"), "").expect("written"),
            ".phase-lock",
            "not in the manifest",
        ),
        (
            "extra folder",
            |root| {
                fs::create_dir(root.join("more")).expect("made");
                fs::write(root.join("more/file"), "").expect("written");
            },
            "more/file",
            "not in the manifest",
        ),
        (
            "folder for a file",
            |root| {
                fs::remove_file(root.join("index.html")).expect("gone");
                fs::create_dir(root.join("index.html")).expect("made");
            },
            "index.html",
            "is not a file",
        ),
        (
            "empty folder",
            |root| fs::create_dir(root.join("more")).expect("made"),
            "more",
            "not in the manifest",
        ),
    ];
    for (name, damage, file, rule) in cases {
        let folder = tempfile::tempdir().expect("a folder");
        let manifest = dataset(folder.path());
        damage(folder.path());
        let found = sentences(folder.path(), &manifest);
        assert_eq!(found.len(), 1, "{name}: {found:?}");
        assert!(found[0].starts_with(&format!("{file}: ")) && found[0].contains(rule), "{name}: {found:?}");
    }
}

/// A change of a file together with its checksum is still detected through other files.
#[test]
fn tampering_is_named() {
    let event = event_path("made-up-1");
    for (from, to, problem) in [
        (
            "\"event\":\"helping\"",
            "\"event\":\"chasing\"",
            "field `kind` is \"chasing\", but the manifest says \"helping\"",
        ),
        ("\"seed\":18446744073709551612", "\"seed\":5", "field `seed` is 5"),
        ("\"base\":20", "\"base\":19", "field `walls`"),
        ("\"id\":\"made-up-1\"", "\"id\":\"made-up-9\"", "field `id` is \"made-up-9\""),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path();
        let mut manifest = dataset(path);
        let text = fs::read_to_string(path.join(&event)).expect("an event").replacen(from, to, 1);
        fs::write(path.join(&event), text).expect("written");
        renew(path, &mut manifest, &event);
        let found = sentences(path, &manifest);
        assert_eq!(found.len(), 1, "{from}: {found:?}");
        assert!(found[0].starts_with(&format!("{event}: ")) && found[0].contains(problem), "{found:?}");
    }

    // A position in an event of which the manifest contains nothing.
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let mut manifest = dataset(path);
    let text = fs::read_to_string(path.join(&event)).expect("an event");
    let changed = text.replacen("[[0,[null,null]],[8,", "[[0,[null,null]],[7,", 1);
    assert_ne!(text, changed);
    fs::write(path.join(&event), changed).expect("written");
    renew(path, &mut manifest, &event);
    let found = sentences(path, &manifest);
    assert_eq!(found, [format!("{DATA}: differs from what PHASE writes for its events")]);
}

/// Files of several row groups and many damages: the result does not depend on the executor or the order of
/// checks.
#[test]
fn the_order_of_checks_does_not_matter() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let mut manifest = crate::manifest::dataset(path, "made-up-0");
    manifest.events = crate::parquet::events(path, &[1; 160]);
    manifest.files = crate::parquet::export(path, &manifest.events).expect("written");
    for number in [99, 150, 158] {
        let event = event_path(&format!("made-up-{number}"));
        let text = fs::read_to_string(path.join(&event)).expect("an event");
        let changed = text.replacen("\"contacts\":[[0,[]],[4,", "\"contacts\":[[0,[]],[5,", 1);
        assert_ne!(text, changed);
        fs::write(path.join(&event), changed).expect("written");
        renew(path, &mut manifest, &event);
    }
    fs::write(path.join(video_path("made-up-7")), "").expect("written");
    manifest.write(path).expect("written");
    let expected: Vec<String> = verify(path, &manifest).iter().map(ToString::to_string).collect();
    let told = expected.join("\n");
    assert_eq!(told.matches(".parquet: differs from what PHASE writes for its events").count(), 2, "{told}");
    assert!(told.contains("made-up-7.mp4: differs in size"), "{told}");

    let told = AtomicUsize::new(0);
    let backwards = |count: usize, check: &Check<'_>| {
        let mut answers: Vec<_> = (0..count).rev().map(check).collect();
        answers.reverse();
        Ok::<_, ()>(answers)
    };
    let found = verify_with(
        path,
        &manifest,
        &|steps| {
            told.fetch_add(steps, Relaxed);
        },
        &mut |_| {},
        backwards,
    );
    let found: Vec<String> = found.expect("checked").iter().map(ToString::to_string).collect();
    assert_eq!(found, expected);
    assert!(told.into_inner() <= work(&manifest));
    let failing = |_: usize, _: &Check<'_>| Err("no threads");
    assert_eq!(
        verify_with(path, &manifest, &|_| {}, &mut |_| {}, failing).expect_err("passed on"),
        "no threads"
    );
}

#[test]
fn manifests_that_lie_are_found_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let manifest = dataset(path);

    let mut fewer = manifest.clone();
    fewer.events.pop();
    let found = sentences(path, &fewer).join("\n");
    assert!(found.contains("events/made-up-2.json: is not in the manifest"), "{found}");
    assert!(found.contains("data/test-00000-of-00001.parquet: "), "{found}");

    let mut reached = manifest.clone();
    reached.events[0].agents[1].reached ^= true;
    let found = sentences(path, &reached);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("field `agents`"), "{found:?}");

    let mut twice = manifest.clone();
    twice.events[1] = twice.events[0].clone();
    let found = sentences(path, &twice).join("\n");
    assert!(found.contains("manifest.json: event made-up-0: field `id` must differ"), "{found}");
    assert!(found.contains("manifest.json: names events/made-up-0.json more than once"), "{found}");

    let mut moved = manifest.clone();
    moved.events[0].split = Some(phase_dataset::splits::Split::Test);
    let found = sentences(path, &moved).join("\n");
    for split in ["train", "test"] {
        let told =
            format!("data/{split}-00000-of-00001.parquet: differs from what PHASE writes for its events");
        assert!(found.contains(&told), "{found}");
    }

    let mut renamed = manifest.clone();
    renamed.events.swap(0, 1);
    let (event, video) = (renamed.events[0].event.clone(), renamed.events[0].video.clone());
    (renamed.events[0].event, renamed.events[0].video) =
        (renamed.events[1].event.clone(), renamed.events[1].video.clone());
    (renamed.events[1].event, renamed.events[1].video) = (event, video);
    let found = sentences(path, &renamed).join("\n");
    assert!(found.contains("the files of the event made-up-1 have other names"), "{found}");

    let mut other = manifest.clone();
    let sum = other.files[0].sha256.clone();
    let text = fs::read_to_string(path.join("croissant.json")).expect("there").replace(&sum, &"0".repeat(64));
    fs::write(path.join("croissant.json"), text).expect("written");
    renew(path, &mut other, "croissant.json");
    let found = sentences(path, &other);
    assert_eq!(
        found,
        [format!(
            "croissant.json: field `distribution` does not give the checksum of {DATA} that the manifest gives"
        )]
    );
}

/// What stands for a file is not one, and nothing behind it is looked at.
#[test]
#[cfg(unix)]
fn links_and_pipes_are_named() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let manifest = dataset(path);
    let elsewhere = tempfile::tempdir().expect("a folder");
    let event = event_path("made-up-1");
    fs::rename(path.join(&event), elsewhere.path().join("copy")).expect("moved");
    symlink(elsewhere.path().join("copy"), path.join(&event)).expect("linked");
    assert_eq!(found(path, &manifest), [format!("{event}: is a link; a dataset holds files")]);
    fs::remove_file(path.join(&event)).expect("removed");
    let made = std::process::Command::new("mkfifo").arg(path.join(&event)).status();
    assert!(made.expect("mkfifo").success());
    assert_eq!(found(path, &manifest), [format!("{event}: is not a file")]);
    fs::remove_file(path.join(&event)).expect("removed");
    fs::rename(elsewhere.path().join("copy"), path.join(&event)).expect("moved back");
    fs::rename(path.join("events"), elsewhere.path().join("events")).expect("moved");
    symlink(elsewhere.path().join("events"), path.join("events")).expect("linked");
    assert_eq!(found(path, &manifest), ["events: is a link; a dataset holds files"]);
}

/// Everything in a file has a meaning, and a file says everything in one way only.
#[test]
fn stray_bytes_are_named() {
    let append = |path: &Path, more: &str| {
        let bytes = fs::read(path).expect("a file");
        fs::write(path, [&bytes, more.as_bytes()].concat()).expect("written");
    };
    let cases: [(&str, &str); 4] = [
        ("events/made-up-1.json", "is not in the form in which it is written"),
        ("videos/made-up-1.mp4", "is not a complete video: 3 bytes follow after its end"),
        ("manifest.json", "manifest.json: is not in the form in which it is written"),
        ("manifest.sha256", "manifest.sha256: differs from the digest of manifest.json"),
    ];
    for (file, rule) in cases {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path();
        let mut manifest = dataset(path);
        append(&path.join(file), " \n ");
        renew(path, &mut manifest, file);
        if !file.starts_with("manifest") {
            manifest.write(path).expect("written");
        }
        let found = found(path, &manifest).join("\n");
        assert!(found.contains(rule), "{found}");
    }
    let folder = tempfile::tempdir().expect("a folder");
    let manifest = dataset(folder.path());
    fs::remove_file(folder.path().join("manifest.sha256")).expect("removed");
    assert_eq!(
        found(folder.path(), &manifest),
        ["manifest.sha256: is not in the manifest, but every dataset has it"]
    );
    manifest.write(folder.path()).expect("written");
    fs::write(folder.path().join("manifest.json.sig"), "a signature").expect("written");
    assert_eq!(found(folder.path(), &manifest), [""; 0]);
}

/// What a file of an event says beside its motion follows from it, or is the same in the whole dataset.
#[test]
fn edits_beside_the_motion_are_named() {
    let event = event_path("made-up-1");
    for (from, to, problem) in [
        ("\"generator\":\"phase test\"", "\"generator\":\"phase 9\"", "field `generator` is \"phase 9\""),
        ("\"settings\":{}", "\"settings\":{\"engine\":\"forward\"}", "field `settings` differs"),
        ("\"row_0\":\"initial state\"", "\"row_0\":\"another\"", "is not in the form"),
        ("\"step_seconds\":0.25", "\"step_seconds\":0.250", "is not in the form"),
        ("\"format\":\"phase-events/1\"", "\"_note\":1,\"format\":\"phase-events/1\"", "is not in the form"),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path();
        let mut manifest = dataset(path);
        let text = fs::read_to_string(path.join(&event)).expect("an event");
        let changed = text.replacen(from, to, 1);
        assert_ne!(text, changed, "{from}");
        fs::write(path.join(&event), changed).expect("written");
        renew(path, &mut manifest, &event);
        let found = sentences(path, &manifest);
        assert_eq!(found.len(), 1, "{from}: {found:?}");
        assert!(found[0].starts_with(&event) && found[0].contains(problem), "{found:?}");
    }
}

/// A video has a frame for each state of its event.
#[test]
fn videos_of_other_events_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let mut manifest = dataset(path);
    let [one, other] = ["made-up-0", "made-up-1"].map(|id| path.join(video_path(id)));
    let (first, second) = (fs::read(&one).expect("a video"), fs::read(&other).expect("a video"));
    fs::write(&one, second).expect("written");
    fs::write(&other, first).expect("written");
    for id in ["made-up-0", "made-up-1"] {
        renew(path, &mut manifest, &video_path(id));
    }
    let found = sentences(path, &manifest);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(
        found[0].contains("made-up-0.mp4: is not a complete video: it has 16 frames instead of 11"),
        "{found:?}"
    );
}
