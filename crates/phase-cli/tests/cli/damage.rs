//! Damaged shards and full disks: no invalid output, and finished output is unchanged.
#![cfg(unix)]

use crate::support::{fail, phase, refuse, run, succeed, text, tree};
use std::{
    fs,
    path::Path,
    process::{Command, Output, Stdio},
    time::Duration,
};

/// Two events whose files are small.
const TINY: [&str; 9] =
    ["gen-dataset", "--events", "2", "--simulations", "10", "--particles", "4", "--max-steps", "2"];

fn generate<'a>(out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&TINY[..], &["--out", out], more].concat()
}

/// A folder with the dataset in one piece, `whole`, and its two shards, `one` and `two`.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    succeed(path, &generate("whole", &[]));
    succeed(path, &generate("one", &["--shard", "1/2"]));
    succeed(path, &generate("two", &["--shard", "2/2"]));
    folder
}

/// Changes one byte in the middle of a file.
fn flip(path: &Path) {
    let mut bytes = fs::read(path).expect("a file");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(path, bytes).expect("written");
}

fn cut(path: &Path) {
    let bytes = fs::read(path).expect("a file");
    fs::write(path, &bytes[..bytes.len() / 2]).expect("written");
}

fn remove(path: &Path) {
    fs::remove_file(path).expect("gone");
}

/// The command, not allowed to write a file longer than the given number of bytes, which imitates a full
/// disk.
fn run_short_of_space(folder: &Path, arguments: &[&str], bytes: usize) -> Output {
    // In blocks of 512 bytes. Ignoring the signal makes writing fail as on a full disk; else it would kill.
    let script = format!("trap '' XFSZ; ulimit -f {}; exec \"$@\"", bytes.div_ceil(512));
    let mut command = Command::new("sh");
    command.current_dir(folder).args(["-c", &script, "sh"]).arg(phase(folder).get_program());
    command.args(arguments).output().expect("a shell")
}

#[test]
fn merge_refuses_damaged_shards_and_goes_on_once_they_are_mended() {
    type Damage = fn(&Path);
    let folder = folder();
    let path = folder.path();
    let whole = tree(&path.join("whole"));
    let cases: [(&str, Damage, &str); 7] = [
        ("two/events/demo-0001.json", flip, "differs in checksum"),
        ("two/events/demo-0001.json", remove, "cannot be read"),
        ("two/videos/demo-0001.mp4", flip, "differs in checksum"),
        ("two/videos/demo-0001.mp4", cut, "differs in size"),
        ("two/slots.jsonl", flip, "differs in checksum"),
        ("two/shard.json", cut, "is truncated"),
        ("two/shard.json", remove, "holds no finished shard"),
    ];
    for (k, (file, damage, rule)) in cases.into_iter().enumerate() {
        let (out, good) = (format!("merged{k}"), fs::read(path.join(file)).expect("a file"));
        damage(&path.join(file));
        let shards = (tree(&path.join("one")), tree(&path.join("two")));
        let sentence = fail(path, &["merge", "one", "two", "--out", &out]);
        assert!(sentence.contains(rule) && sentence.contains("two"), "{file}: {sentence}");
        assert!(!path.join(&out).join("manifest.json").exists(), "{file}");
        assert!((tree(&path.join("one")), tree(&path.join("two"))) == shards, "{file}: a shard was changed");

        fs::write(path.join(file), good).expect("mended");
        succeed(path, &["merge", "one", "two", "--out", &out]);
        assert!(tree(&path.join(&out)) == whole, "{file}: merged otherwise once it was mended");
    }
}

/// A merge that was killed after its last file is finished by the same command; another dataset is not
/// overwritten.
#[test]
fn a_finished_merge_is_left_as_it_is() {
    let folder = folder();
    let path = folder.path();
    let whole = tree(&path.join("whole"));
    let merge = ["merge", "one", "two", "--out", "merged"];
    succeed(path, &merge);
    let merged = path.join("merged");
    // In the order in which they are removed at the end.
    for left in [
        &[".cache", ".phase-run.json", ".phase-lock"][..],
        &[".phase-run.json", ".phase-lock"],
        &[".phase-lock"],
        &[],
    ] {
        for name in left {
            match *name {
                ".cache" => fs::create_dir(merged.join(name)).expect("a folder"),
                name => fs::write(merged.join(name), "{\"format\":\"phase-run/2\"}\n").expect("written"),
            }
        }
        let told = succeed(path, &merge);
        assert!(told.contains("holds this dataset already"), "{left:?}: {told}");
        assert!(tree(&merged) == whole, "{left:?}");
        succeed(path, &["verify", "merged"]);
    }
    flip(&merged.join("events/demo-0001.json"));
    assert!(refuse(path, &merge).contains("differs in checksum"));
    succeed(path, &generate("other", &["--seed", "9"]));
    let other = tree(&path.join("other"));
    let sentence = refuse(path, &["merge", "one", "two", "--out", "other"]);
    assert!(
        sentence.contains("holds a finished run of another kind") && tree(&path.join("other")) == other,
        "{sentence}"
    );
}

/// Room for the file that names the run, and too little for an event (bytes).
const RUN_FILE: usize = 4096;

#[test]
fn without_space_it_fails_and_goes_on_once_there_is_some() {
    let folder = folder();
    let path = folder.path();
    let whole = tree(&path.join("whole"));
    let size = |name: &str| whole[Path::new(name)].len();
    let of_events = ["events/demo-0000.json", "events/demo-0001.json"];
    let of_videos = ["videos/demo-0000.mp4", "videos/demo-0001.mp4"];
    let longest = of_events.iter().chain(&of_videos).map(|name| size(name)).max().expect("four");
    assert!(size("croissant.json") > longest + 512, "the limits below have to lie between them");

    assert!(of_events.iter().all(|name| size(name) > RUN_FILE + 512), "the limit has to lie below events");
    let merge = |out: &'static str| vec!["merge", "one", "two", "--out", out];
    let cases: [(&str, Vec<&str>, usize, usize); 4] = [
        ("nothing", generate("nothing", &[]), RUN_FILE, 0),
        ("all-events", generate("all-events", &[]), longest, 4),
        ("merge-nothing", merge("merge-nothing"), RUN_FILE, 0),
        ("merge-all-events", merge("merge-all-events"), longest, 4),
    ];
    for (out, arguments, limit, kept) in cases {
        let output = run_short_of_space(path, &arguments, limit);
        let told = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{out}: {told}");
        let sentence = told.lines().last().unwrap_or_default();
        assert!(
            sentence.starts_with("error: ") && sentence.contains("cannot write the file: "),
            "{out}: {told}"
        );
        assert!(sentence.ends_with("the same command goes on from what is finished there"), "{out}: {told}");

        let left = tree(&path.join(out));
        let files =
            || of_events.iter().chain(&of_videos).filter_map(|name| left.get_key_value(Path::new(name)));
        assert!(files().all(|(name, bytes)| *bytes == whole[name]), "{out}: something is half-written");
        assert_eq!(files().count(), kept, "{out}");
        assert!(!left.contains_key(Path::new("manifest.json")), "{out}");
        let part = |name: &Path| name.extension().is_some_and(|it| it == "part");
        assert!(!left.keys().any(|name| part(name)), "{out}: {:?}", left.keys());

        let output = run(path, &arguments);
        let told = text(&output.stderr);
        assert!(output.status.success(), "{out}: {told}");
        let resumed = told.matches("(kept)").count();
        assert_eq!(resumed, if out == "all-events" { 2 } else { 0 }, "{out}: {told}");
        assert!(tree(&path.join(out)) == whole, "{out}: the resumed run differs");
    }
}

/// If the folder of a run is removed, what was finished is lost, and the program says so.
#[test]
fn a_folder_that_is_removed_meanwhile_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let mut arguments = generate("out", &["--no-video"]);
    arguments[2] = "500";
    let mut command = phase(path);
    let run = command.args(&arguments).stderr(Stdio::piped()).stdout(Stdio::null()).spawn().expect("started");
    let events = path.join("out/events");
    while fs::read_dir(&events).map_or(0, Iterator::count) < 3 {
        std::thread::sleep(Duration::from_millis(5));
    }
    // At once: while it is removed file by file, some of what was finished is still there.
    fs::rename(path.join("out"), path.join("gone")).expect("moved away");
    let output = run.wait_with_output().expect("ended");
    let told = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(told.contains("its folder is no longer there, nor is what was finished in it"), "{told}");
    assert!(!told.contains("is kept"), "{told}");
}
