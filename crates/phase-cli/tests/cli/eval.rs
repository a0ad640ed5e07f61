//! `eval`, with the trivial baselines.

use crate::support::{recording, refuse, run, succeed, text, tree, write_events};
use serde_json::{Value, json};
use std::{fs, path::Path};

/// A recording of `steps` steps in which agent 0 moves along x at 0.6 u/s and nothing else moves.
pub(crate) fn moving(id: &str, steps: usize) -> Value {
    let mut event = recording(id);
    let still = |x: f64, y: f64| vec![json!([x, y, 0.0, 0.0, 0.5]); steps + 1];
    let going = |t: usize| json!([8.5 + 0.05 * t as f64, 19.5, 0.6, 0.0, 0.5]);
    event["trajectory"]["agents"] = json!([(0..=steps).map(going).collect::<Vec<_>>(), still(20.0, 8.0)]);
    event["trajectory"]["objects"] = json!([still(12.0, 8.0)]);
    event
}

pub(crate) fn events_of(path: &Path) {
    let events: Vec<Value> = (0..6).map(|k| moving(&format!("event-{k}"), 30 + 3 * k)).collect();
    write_events(&path.join("events.json"), &events);
}

pub(crate) fn results(file: &Path) -> Value {
    serde_json::from_slice(&fs::read(file).expect("results")).expect("JSON")
}

const GOALS: [&str; 6] = ["eval", "goals", "--method", "chance", "--events", "events.json"];

#[test]
fn trajectories_by_hand() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    let common = ["--events", "events.json", "--json", "out.json", "--method"];
    let eval = |method| succeed(path, &[&["eval", "trajectories"], &common[..], &[method]].concat());
    let table = eval("constant-velocity");
    assert!(table.contains("STGAT") && table.contains("constant-velocity (ours), agents"), "{table}");
    // It keeps its velocity, so that is where it goes.
    let exact = results(&path.join("out.json"));
    assert!(exact["ade"]["all"].as_f64().expect("a number") < 1e-4, "{}", exact["ade"]);
    assert_eq!((&exact["n_events"], &exact["shorter"]), (&json!(6), &json!(4)));
    assert_eq!((&exact["ade"]["social"], &exact["intervals"]["ade"]["social"]), (&Value::Null, &Value::Null));
    eval("still");
    // After n steps agent 0 is 0.05 n away from where it was, agent 1 not at all; events have 10, 13, 16, 19,
    // 20, 20.
    let still = results(&path.join("out.json"));
    let lengths = [10.0, 13.0, 16.0, 19.0, 20.0, 20.0];
    let fde = lengths.iter().map(|n| 0.05 * n / 2.0).sum::<f64>() / 6.0;
    let ade = lengths.iter().map(|n| 0.05 * (n + 1.0) / 4.0).sum::<f64>() / 6.0;
    for (found, expected) in [("fde", fde), ("ade", ade)] {
        let found = still[found]["independent"].as_f64().expect("a number");
        assert!((found - expected).abs() < 1e-5, "{found} {expected}");
    }
    for file in ["report.md", "report.html", "by-step.svg", "events/event-0.json", "results.json"] {
        assert!(path.join("out/eval/trajectories-still-events").join(file).is_file(), "{file}");
    }
}

#[test]
fn threads_and_company_change_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    for (out, more) in
        [("one", &["--jobs", "1", "--watched", "5"][..]), ("two", &["--jobs", "2", "--watched", "5"])]
    {
        succeed(path, &[&GOALS[..], more, &["--out", out]].concat());
    }
    let one = results(&path.join("one/results.json"));
    assert_eq!(one, results(&path.join("two/results.json")));
    assert_eq!(one["watched"][0]["n"], 6);
    assert_eq!(one["events"][0]["watched"][0]["seconds"], 5.0);
    // The seed of an event is its own.
    succeed(path, &[&GOALS[..], &["--limit", "2", "--watched", "5", "--out", "few"]].concat());
    let few = results(&path.join("few/results.json"));
    assert_eq!((&few["n_events"], &few["events"][1]), (&json!(2), &one["events"][1]));
    succeed(path, &[&GOALS[..], &["--seed", "2", "--watched", "5", "--out", "other"]].concat());
    assert_ne!(results(&path.join("other/results.json"))["events"], one["events"]);
    // Ten own goals of an agent, equally likely.
    let goals = one["events"][0]["goals"][0].as_array().expect("goals");
    assert!(goals.len() == 10 && goals.iter().all(|share| share["p"] == 0.1), "{goals:?}");
}

#[test]
fn a_run_broken_off_goes_on_to_the_same_results() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    succeed(path, &[&GOALS[..], &["--out", "straight"]].concat());
    let straight = results(&path.join("straight/results.json"));
    // The files of a run that was stopped after some events, one of whose files was damaged since.
    fs::create_dir_all(path.join("stopped/events")).expect("a folder");
    fs::write(path.join("stopped/.phase-run.json"), straight["run"].to_string()).expect("written");
    for name in ["events/event-0.json", "events/event-3.json"] {
        fs::copy(path.join("straight").join(name), path.join("stopped").join(name)).expect("copied");
    }
    fs::write(path.join("stopped/events/event-4.json"), "{\"program\"").expect("written");
    let sentence = refuse(path, &[&GOALS[..], &["--out", "stopped", "--seed", "2"]].concat());
    assert!(sentence.contains("unfinished") && sentence.contains("seed 1 instead of 2"), "{sentence}");
    let output = run(path, &[&GOALS[..], &["--out", "stopped"]].concat());
    let said = text(&output.stderr);
    assert!(output.status.success() && said.matches("(kept)").count() == 2, "{said}");
    assert_eq!(results(&path.join("stopped/results.json")), straight);

    // A finished one is used unchanged, unless it is another one or was changed.
    let before = tree(&path.join("stopped"));
    let told = succeed(path, &[&GOALS[..], &["--out", "stopped", "--json", "again.json"]].concat());
    assert!(told.contains("holds this evaluation already"), "{told}");
    assert_eq!(results(&path.join("again.json")), straight);
    let sentence = refuse(path, &[&GOALS[..], &["--out", "stopped", "--watched", "5"]].concat());
    assert!(sentence.contains("finished") && sentence.contains("watched"), "{sentence}");
    assert!(tree(&path.join("stopped")) == before);
    let file = path.join("stopped/results.json");
    let changed = fs::read_to_string(&file).expect("text").replacen("\"n_events\": 6", "\"n_events\": 7", 1);
    fs::write(&file, changed).expect("written");
    refuse(path, &[&GOALS[..], &["--out", "stopped"]].concat());
}

#[test]
fn rubbish_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    write_events(&path.join("short.json"), &[moving("short", 20)]);
    fs::write(path.join("rubbish.json"), "{\"events\": 3}").expect("written");
    fs::create_dir(path.join("empty")).expect("a folder");
    let goals = |events: &'static str| ["eval", "goals", "--method", "chance", "--events", events];
    let theirs = ["eval", "goals", "--events", "events.json", "--predictions"];
    let cases: &[(&[&str], &[&str])] = &[
        (&goals("missing.json"), &["missing.json", "no such file"]),
        (&goals("rubbish.json"), &["rubbish.json", "format"]),
        (&goals("empty"), &["empty", "manifest.json"]),
        (&[&goals("events.json")[..], &["--split", "test"]].concat(), &["events.json", "--split"]),
        (&[&goals("events.json")[..], &["--split", "exam"]].concat(), &["exam", "validation"]),
        (&[&goals("events.json")[..], &["--watched", "5,1.1"]].concat(), &["--watched", "1.1"]),
        (&[&goals("events.json")[..], &["--watched", "NaN"]].concat(), &["--watched", "NaN"]),
        (&[&goals("events.json")[..], &["--limit", "0"]].concat(), &["--limit"]),
        (&[&goals("events.json")[..], &["--json", "no/such.json"]].concat(), &["no/such.json", "folder"]),
        (&[&goals("events.json")[..], &["--json", "empty"]].concat(), &["empty", "--json"]),
        (&[&goals("events.json")[..], &["--out", "events.json"]].concat(), &["events.json", "is a file"]),
        (&["eval", "goals", "--events", "events.json"], &["--method"]),
        (&["eval", "trajectories", "--events", "events.json"], &["--method"]),
        (&["eval", "goals", "--method", "guess", "--events", "events.json"], &["guess", "chance"]),
        (&["eval", "trajectories", "--method", "chance", "--events", "events.json"], &["chance", "still"]),
        (
            &["eval", "beliefs", "--method", "last-seen", "--events", "events.json"],
            &["events.json", "was not simulated"],
        ),
        (
            &["eval", "beliefs", "--method", "belief-network", "--order", "2", "--events", "events.json"],
            &["--order 2", "belief-network"],
        ),
        (
            &[
                "eval",
                "beliefs",
                "--method",
                "simple",
                "--weights",
                "rubbish.json",
                "--events",
                "events.json",
            ],
            &["--weights", "simple"],
        ),
        (
            &["eval", "trajectories", "--method", "still", "--events", "short.json"],
            &["short.json", "event short has 20 steps"],
        ),
        (&[&goals("events.json")[..], &["--weights", "rubbish.json"]].concat(), &["--weights", "chance"]),
        (&[&theirs[..], &["events.json", "--watched", "5"]].concat(), &["--watched"]),
        (&[&theirs[..], &["events.json", "--minds", "phase"]].concat(), &["--predictions", "--minds"]),
        (&[&theirs[..], &["events.json", "--simulations", "9"]].concat(), &["--simulations"]),
        (&[&theirs[..], &["events.json", "--one-way-turns"]].concat(), &["--one-way-turns"]),
        (&[&theirs[..], &["events.json", "--strongest-coasts"]].concat(), &["--strongest-coasts"]),
        (&[&theirs[..], &["events.json", "--original-random"]].concat(), &["--original-random"]),
        (&[&theirs[..], &["events.json", "--method", "chance"]].concat(), &["--predictions", "--method"]),
        (&[&theirs[..], &["events.json", "--weights", "w.safetensors"]].concat(), &["--weights"]),
    ];
    let before = tree(path);
    // Without networks all that is said of this method is that there are none.
    let is_built = |arguments: &[&str]| cfg!(feature = "networks") || !arguments.contains(&"belief-network");
    for (arguments, expected) in cases.iter().filter(|(arguments, _)| is_built(arguments)) {
        let sentence = refuse(path, arguments);
        for part in *expected {
            assert!(sentence.contains(part), "{arguments:?}: {part:?} is not in {sentence:?}");
        }
        assert_eq!(tree(path), before, "{arguments:?}");
    }
}

#[test]
fn only_simple_has_minds_to_choose() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    let refused = refuse(path, &[&GOALS[..], &["--minds", "published"]].concat());
    assert!(refused.contains("\"chance\" has no minds"), "{refused}");
    let asked = ["eval", "goals", "--method", "simple", "--events", "events.json", "--limit", "1"];
    succeed(path, &[&asked[..], &["--minds", "published", "--one-way-turns", "--json", "out.json"]].concat());
    let results = results(&path.join("out.json"));
    assert_eq!(results["method"], "simple-published-minds");
    let agents = &results["run"]["method_settings"]["method"]["agents"];
    assert_eq!(agents["minds"]["kind"], "published");
    assert_eq!(agents["one_way_turns"], true);
}

#[test]
fn parts_are_merged_to_the_bytes_of_one_run() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    succeed(path, &[&GOALS[..], &["--out", "whole"]].concat());
    let part = |k: usize, of: usize| {
        let (shard, out) = (format!("{k}/{of}"), format!("part{k}"));
        succeed(path, &[&GOALS[..], &["--shard", &shard, "--out", &out]].concat());
        // Done already.
        succeed(path, &[&GOALS[..], &["--shard", &shard, "--out", &out]].concat());
        assert!(!path.join(out).join("results.json").exists());
    };
    (1..=4).for_each(|k| part(k, 4));
    let merge =
        |out: &str, parts: &[&str]| [&GOALS[..], &["--out", out, "--merge"], parts].concat().join(" ");
    let merged = merge("merged", &["part3", "part1", "part4", "part2"]);
    succeed(path, &merged.split(' ').collect::<Vec<_>>());
    let bytes = |run: &str| fs::read(path.join(run).join("results.json")).expect("results");
    assert!(bytes("merged") == bytes("whole"), "merged parts differ from one run");

    let refused = |parts: &[&str]| {
        let told = refuse(path, &merge("other", parts).split(' ').collect::<Vec<_>>());
        assert!(!path.join("other").exists(), "{told}");
        told
    };
    assert!(refused(&["part1", "part2", "part4"]).contains("shard 3 of 4 is missing"));
    assert!(refused(&["part1", "part2", "part3"]).contains("shard 4 of 4 is missing"));
    assert!(refused(&["part1", "part2", "part2", "part3", "part4"]).contains("are both shard 2"));
    assert!(refused(&["part1", "whole"]).contains("holds no finished part"));
    let cue = GOALS.map(|word| if word == "chance" { "cue" } else { word });
    let told = refuse(path, &[&cue[..], &["--out", "other", "--merge", "part1"]].concat());
    assert!(told.contains("method \"chance\" instead of \"cue\""), "{told}");

    // Every answer of a part is needed.
    fs::remove_file(path.join("part2/events/event-5.json")).expect("removed");
    let told = text(
        &run(path, &merge("other", &["part1", "part2", "part3", "part4"]).split(' ').collect::<Vec<_>>())
            .stderr,
    );
    assert!(told.contains("part2/events/event-5.json") && told.contains("no answer"), "{told}");
}

/// The difference of two methods is that of their results; results of other events or of another task are
/// refused by name.
#[test]
fn methods_are_compared_on_the_same_events() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    let of =
        |method| ["eval", "trajectories", "--method", method, "--events", "events.json", "--out", method];
    succeed(path, &of("still"));
    let compared = ["--compare", "still/results.json", "--json", "out.json"];
    let told = succeed(path, &[&of("constant-velocity")[..], &compared].concat());
    let [one, other] =
        ["constant-velocity", "still"].map(|name| results(&path.join(name).join("results.json")));
    let found = results(&path.join("out.json"));
    for measure in ["ade", "fde"] {
        let of = |results: &Value| results[measure]["all"].as_f64().expect("a number");
        let difference = &found["comparison"][0]["difference"][measure];
        let [value, low, high] =
            ["value", "low", "high"].map(|part| difference[part].as_f64().expect("a number"));
        assert!((value - (of(&one) - of(&other))).abs() < 1e-6, "{measure}: {value}");
        assert!(low <= value && value <= high);
        assert!(told.contains(&format!("{measure} {value:+.3} [")), "{told}");
    }
    assert!(told.contains("less still/results.json: ade"), "{told}");
    write_events(&path.join("few.json"), &[moving("another", 30)]);
    let few = ["eval", "trajectories", "--method", "still", "--events", "few.json", "--out", "few"];
    let goals = ["--compare", "still/results.json", "--out", "goals"];
    for arguments in [[&few[..], &compared[..2]].concat(), [&GOALS[..], &goals].concat()] {
        let output = run(path, &arguments);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("--compare: still/results.json: "), "{said}");
    }
}
