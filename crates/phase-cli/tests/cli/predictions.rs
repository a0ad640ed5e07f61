//! `eval --predictions`: answers of an external method.

use crate::{
    eval::{events_of, moving, results},
    support::{refuse, run, succeed, text, write_events},
};
use serde_json::{Value, json};
use std::{fs, path::Path, process::Command};

/// Scores a file on `events.json`; the results without CPU times.
fn score(path: &Path, task: &str, file: &str) -> Value {
    let events = ["--events", "events.json", "--json", "scored.json", "--predictions", file];
    let table = succeed(path, &[&["eval", task], &events[..]].concat());
    assert!(table.contains(" (predictions)") && !table.contains("(ours)"), "{table}");
    results(&path.join("scored.json"))
}

fn write(path: &Path, file: &str, value: &Value) {
    fs::write(path.join(file), value.to_string()).expect("written");
}

/// Where every entity of [`moving`] is from step 21 on.
fn came(steps: usize) -> Value {
    let path = |at: &dyn Fn(usize) -> Value| (1..=steps).map(|step| at(20 + step)).collect::<Vec<_>>();
    json!([
        path(&|t| json!([8.5 + 0.05 * t as f64, 19.5])),
        path(&|_| json!([20.0, 8.0])),
        path(&|_| json!([12.0, 8.0])),
    ])
}

#[test]
fn answers_of_others_are_scored() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    let goal =
        |agent: u8| json!({ "kind": "agent_on_landmark", "agent": agent, "landmark": agent, "sign": 1 });
    let event = |k: usize| {
        // Agent 0 is always correct, agent 1 never; the relation of every other event.
        let relation =
            json!({ "friendly": (k % 2) as f64, "adversarial": 0.0, "neutral": (1 - k % 2) as f64 });
        let goals = json!([[{ "goal": goal(0), "p": 0.9 }], [{ "goal": goal(0), "p": 0.9 }]]);
        json!({ "id": format!("event-{k}"), "goals": goals, "relation": relation })
    };
    write(path, "theirs.json", &json!({ "events": (0..6).map(event).collect::<Vec<_>>() }));
    let found = score(path, "goals", "theirs.json");
    assert_eq!(found["goal"], json!({ "top1": 0.5, "top2": 0.5, "top3": 0.5 }));
    assert_eq!(found["relation"], json!({ "accuracy": 0.5, "human_accuracy": null }));
    assert_eq!(found["method"], "theirs");
    // Results are valid predictions too.
    write(path, "results.json", &found);
    assert_eq!(score(path, "goals", "results.json")["goal"], found["goal"]);
    // The name of a method does not decide where anything is written.
    let far = json!({ "method": "../../far/off", "events": (0..6).map(event).collect::<Vec<_>>() });
    write(path, "far.json", &far);
    succeed(path, &["eval", "goals", "--predictions", "far.json", "--events", "events.json"]);
    assert!(path.join("out/eval/goals-..-..-far-off-events/results.json").is_file());
    let written: Vec<_> = fs::read_dir(path.join("out")).expect("a folder").collect();
    assert_eq!(written.len(), 1, "{written:?}");
    write(path, "fewer.json", &json!({ "events": (1..6).map(event).collect::<Vec<_>>() }));
    let sentence = refuse(path, &["eval", "goals", "--predictions", "fewer.json", "--events", "events.json"]);
    assert!(sentence.contains("fewer.json") && sentence.contains("event-0"), "{sentence}");
}

/// Ratings are compared with the answers; files that are about other events, or are no ratings, are refused.
#[test]
fn answers_are_compared_with_people() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    let event = |k: usize| {
        let relation =
            json!({ "friendly": (k % 2) as f64, "adversarial": 0.0, "neutral": (1 - k % 2) as f64 });
        let roles = json!({ "helps": [0.5, 0.0], "hinders": [0.0, 0.0] });
        json!({ "id": format!("event-{k}"), "goals": [[], []], "relation": relation, "roles": roles })
    };
    write(path, "theirs.json", &json!({ "events": (0..6).map(event).collect::<Vec<_>>() }));
    let rated = |k: usize| json!({ "friendly": 10 * (k % 2), "neutral": 10 * (1 - k % 2), "adversarial": 0 });
    let rated = |ids: &[usize]| {
        let members = ids.iter().map(|&k| (format!("event-{k}"), rated(k)));
        json!({ "format": "phase-ratings/1", "ratings": members.collect::<serde_json::Map<_, _>>() })
    };
    write(path, "rated.json", &rated(&[0, 1, 2, 9]));
    let command = ["eval", "goals", "--predictions", "theirs.json", "--events", "events.json"];
    let with = |file: &'static str| {
        [&command[..], &["--ratings", file, "--out", "out", "--json", "scored.json"]].concat()
    };
    succeed(path, &with("rated.json"));
    let found = results(&path.join("scored.json"));
    let agreement = &found["agreement"];
    assert_eq!((&agreement["n"], &agreement["ratings"]), (&json!(3), &json!(30)));
    assert_eq!((&agreement["correlation"]["value"], &agreement["mode"]["value"]), (&json!(1.0), &json!(1.0)));
    assert!(
        fs::read_to_string(path.join("out/report.md")).expect("a report").contains("Agreement with people")
    );
    // The same folder with other ratings is another run.
    write(path, "others.json", &rated(&[0, 1]));
    assert!(refuse(path, &with("others.json")).contains("ratings_sha256"));
    write(path, "strangers.json", &rated(&[7, 9]));
    let sentence = refuse(path, &[&command[..], &["--ratings", "strangers.json"]].concat());
    assert!(sentence.contains("strangers.json") && sentence.contains("event-0"), "{sentence}");
    let sentence = refuse(path, &[&command[..], &["--ratings", "theirs.json"]].concat());
    assert!(sentence.contains("theirs.json") && sentence.contains("format"), "{sentence}");
}

#[test]
fn forecasts_of_others_are_scored() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    // Events have 10, 13, 16, 19, 20, 20 steps to predict; half of the forecasts go on to step 40.
    let lengths = [10, 13, 16, 19, 20, 20];
    let event = |k: usize, shift: f64| {
        let mut forecast = came(if k.is_multiple_of(2) { 20 } else { lengths[k] });
        for at in forecast[0].as_array_mut().expect("a path") {
            at[1] = json!(19.5 + shift);
        }
        json!({ "id": format!("event-{k}"), "forecast": forecast })
    };
    let all = |shift: f64| json!({ "events": (0..6).map(|k| event(k, shift)).collect::<Vec<_>>() });
    write(path, "perfect.json", &all(0.0));
    let perfect = score(path, "trajectories", "perfect.json");
    assert_eq!((&perfect["method"], &perfect["n_events"]), (&json!("perfect"), &json!(6)));
    for name in ["ade", "fde", "ade_entities", "fde_entities"] {
        assert_eq!(perfect[name]["all"], 0.0, "{name}");
    }
    let kept = perfect["events"].as_array().expect("events").iter();
    let kept: Vec<usize> = kept.map(|event| event["forecast"][2].as_array().map_or(0, Vec::len)).collect();
    assert_eq!(kept, lengths);
    // One agent of two is 3 u off, one entity of three, throughout.
    write(path, "off.json", &all(3.0));
    let off = score(path, "trajectories", "off.json");
    for (name, expected) in [("ade", 1.5), ("fde", 1.5), ("ade_entities", 1.0), ("fde_entities", 1.0)] {
        assert_eq!(off[name]["independent"], expected, "{name}");
    }
    // Extreme but finite numbers still have a distance.
    write(path, "far.json", &all(3e38));
    assert!(score(path, "trajectories", "far.json")["fde"]["all"].as_f64() > Some(1e38));
}

#[test]
fn forecasts_of_ours_score_as_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    events_of(path);
    let ours = ["eval", "trajectories", "--method", "constant-velocity", "--events", "events.json"];
    succeed(path, &[&ours[..], &["--json", "ours.json"]].concat());
    let mut ours = results(&path.join("ours.json"));
    let mut again = score(path, "trajectories", "ours.json");
    for results in [&mut ours, &mut again] {
        for name in ["run", "method"] {
            results[name].take();
        }
    }
    assert_eq!(again, ours);
    // Unselected events are skipped with a note, and the run resumes.
    let few =
        ["eval", "trajectories", "--predictions", "ours.json", "--events", "events.json", "--limit", "2"];
    let output = run(path, &[&few[..], &["--out", "few"]].concat());
    let said = text(&output.stderr);
    assert!(
        output.status.success() && said.contains("note: ours.json: 4 of its events are not evaluated"),
        "{said}"
    );
    assert!(succeed(path, &[&few[..], &["--out", "few"]].concat()).contains("holds this evaluation already"));
}

#[test]
fn rubbish_is_refused_in_one_sentence() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    write_events(&path.join("events.json"), &[moving("one", 30), moving("two", 60)]);
    let goal = json!({ "kind": "touch", "agent": 0, "other": 1, "sign": 1 });
    let event = |id: &str, steps: usize| {
        json!({
            "id": id, "forecast": came(steps), "goals": [[{ "goal": goal, "p": 0.5 }], []],
            "relation": { "friendly": 0.5, "adversarial": 0.5, "neutral": 0 },
        })
    };
    let good = json!({ "events": [event("one", 10), event("two", 20)] });
    write(path, "bad.json", &good);
    score(path, "goals", "bad.json");
    score(path, "trajectories", "bad.json");
    let long = came(20);
    let cases = [
        ("both", "", json!([]), "must be an object, not []"),
        ("both", "/events", json!({}), "field `events` must be an array, not {}"),
        ("both", "/events", json!([]), "field `events` must hold at least one event"),
        ("both", "/events/0", json!(7), "event number 1: must be an object, not 7"),
        ("both", "/events/1/id", json!(null), "event number 2: field `id` must be a text, not null"),
        (
            "both",
            "/events/1/id",
            json!("one"),
            "event one: field `id` must differ from that of every other event, and not in case alone",
        ),
        (
            "both",
            "/events/1/id",
            json!("tow"),
            "has no answer to 1 of the 2 events of events.json: two; it has tow, one",
        ),
        ("goals", "/events/1/goals/1", json!({}), "event two: field `goals[1]` must be an array, not {}"),
        (
            "goals",
            "/events/1/goals/0/0/p",
            json!(-1),
            "event two: field `goals[0][0].p` must be a number from 0 to 1, not -1",
        ),
        (
            "trajectories",
            "/events/0/forecast",
            json!("far"),
            "event one: field `forecast` must be an array, not \"far\"",
        ),
        (
            "trajectories",
            "/events/0/forecast",
            json!([long[0], long[1]]),
            "event one: field `forecast` must hold 3 lists, one for each agent and then for each object, not 2",
        ),
        (
            "trajectories",
            "/events/0/forecast/2",
            json!(null),
            "event one: field `forecast[2]` must be an array, not null",
        ),
        (
            "trajectories",
            "/events/0/forecast/2",
            json!([]),
            "event one: field `forecast[2]` must hold 10 to 20 positions, not 0",
        ),
        (
            "trajectories",
            "/events/0/forecast/1",
            came(21)[1].clone(),
            "event one: field `forecast[1]` must hold 10 to 20 positions, not 21",
        ),
        (
            "trajectories",
            "/events/1/forecast/0",
            came(19)[0].clone(),
            "event two: field `forecast[0]` must hold 20 positions, not 19",
        ),
        (
            "trajectories",
            "/events/1/forecast/0/3",
            json!(4),
            "event two: field `forecast[0][3]` must be an array, not 4",
        ),
        (
            "trajectories",
            "/events/1/forecast/0/3",
            json!([1, 2, 3]),
            "event two: field `forecast[0][3]` must be [x, y], not [1,2,3]",
        ),
        (
            "trajectories",
            "/events/1/forecast/0/3",
            json!([1, null]),
            "event two: field `forecast[0][3]` must be two finite numbers, not [1,null]",
        ),
        (
            "trajectories",
            "/events/1/forecast/0/3",
            json!([1, 1e300]),
            "event two: field `forecast[0][3]` must be two finite numbers, not [1,1e+300]",
        ),
    ];
    let say =
        |task: &str| refuse(path, &["eval", task, "--predictions", "bad.json", "--events", "events.json"]);
    for (tasks, pointer, to, rule) in cases {
        let mut bad = good.clone();
        *bad.pointer_mut(pointer).expect(pointer) = to;
        write(path, "bad.json", &bad);
        for task in ["goals", "trajectories"].into_iter().filter(|task| [task, "both"].contains(&tasks)) {
            assert_eq!(say(task).trim_end(), format!("error: bad.json: {rule}"), "{task} {pointer}");
        }
    }
    for (field, task) in
        [("id", "goals"), ("id", "trajectories"), ("goals", "goals"), ("forecast", "trajectories")]
    {
        let mut bad = good.clone();
        bad["events"][0].as_object_mut().expect("an event").remove(field);
        write(path, "bad.json", &bad);
        let event = if field == "id" { "number 1" } else { "one" };
        let expected = format!("error: bad.json: event {event}: field `{field}` is missing");
        assert_eq!(say(task).trim_end(), expected);
    }
    // Text that is not JSON, or JSON in which numbers are not allowed.
    for (contents, rule) in [
        ("", "is empty"),
        ("{\"events\": [", "is truncated: the JSON ends unfinished in line 1"),
        ("{\"events\": [NaN]}", "holds NaN in line 1: numbers must be finite"),
    ] {
        fs::write(path.join("bad.json"), contents).expect("written");
        assert_eq!(say("trajectories").trim_end(), format!("error: bad.json: {rule}"));
    }
}

/// The worked example of docs/how-to/method.md. Its rules are those of its own text; their results here are
/// computed by hand.
#[test]
fn the_example_in_python_is_accepted() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/examples/external_method.py");
    let python = |arguments: &[&str]| {
        Command::new("python3").arg("-B").arg(&script).args(arguments).current_dir(path).output()
    };
    if !python(&["--help"]).is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: there is no python3");
        return;
    }
    let write_predictions = |arguments: &[&str], out: &str| {
        let output = python(&[arguments, &["--out", out]].concat()).expect("python3 starts");
        assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
        ["goals", "trajectories"]
            .map(|task| fs::read(path.join(out).join(task).join("rules-of-thumb.json")).expect("a file"))
    };
    events_of(path);
    let said = write_predictions(&["events.json"], "said");
    // Agent 0 stays by landmark 0, its goal; agent 1 stands closest to landmark 2 but its goal is 1. Neither
    // interferes.
    let goals = score(path, "goals", "said/goals/rules-of-thumb.json");
    assert_eq!((&goals["method"], &goals["goal"]["top1"]), (&json!("rules-of-thumb"), &json!(0.5)));
    assert_eq!(goals["relation"]["accuracy"], 1.0);
    // Agent 0 moves 0.05 u a step, but is forecast to keep 0.85 of that from step to step.
    let off = |steps: u8| 0.05 * (1..=i32::from(steps)).map(|step| 1.0 - 0.85_f64.powi(step)).sum::<f64>();
    let fde = [10, 13, 16, 19, 20, 20].map(|steps| off(steps) / 2.0).iter().sum::<f64>() / 6.0;
    let trajectories = score(path, "trajectories", "said/trajectories/rules-of-thumb.json");
    let found = trajectories["fde"]["all"].as_f64().expect("a number");
    assert!((found - fde).abs() < 1e-5, "{found} {fde}");

    // It must not use the answers: with others in the file its output is the same.
    let mut file: Value =
        serde_json::from_slice(&fs::read(path.join("events.json")).expect("events")).expect("JSON");
    for event in file["events"].as_array_mut().expect("events") {
        event["event"] = json!("hindering");
        event["relation"] = json!("adversarial");
        for agent in [0, 1] {
            event["agents"][agent]["goal"] = json!({ "kind": "touch", "agent": 1, "other": 0, "sign": -1 });
            event["agents"][agent]["alpha"] = json!(-1);
        }
    }
    write(path, "others.json", &file);
    assert!(write_predictions(&["others.json"], "others") == said);
    // For Task 2 it must not use rows beyond row 20.
    for event in file["events"].as_array_mut().expect("events") {
        for rows in event["trajectory"]["agents"].as_array_mut().expect("agents") {
            rows.as_array_mut().expect("rows").truncate(21);
        }
    }
    write(path, "begun.json", &file);
    assert!(write_predictions(&["begun.json"], "begun")[1] == said[1]);

    // A dataset is read through its manifest, as far as one split goes.
    let entry = |id: &str, split: &str| {
        write_events(&path.join(format!("{id}.json")), &[moving(id, 30)]);
        json!({ "id": id, "split": split, "event": { "path": format!("{id}.json") } })
    };
    write(path, "manifest.json", &json!({ "events": [entry("a", "train"), entry("b", "test")] }));
    for file in write_predictions(&[".", "--split", "test"], "split") {
        let file: Value = serde_json::from_slice(&file).expect("JSON");
        assert_eq!(
            (file["events"].as_array().map(Vec::len), &file["events"][0]["id"]),
            (Some(1), &json!("b"))
        );
    }
}
