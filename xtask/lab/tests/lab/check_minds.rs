//! `check-minds` on recordings whose figures can be told by hand, with minds that search little.

use crate::support::{recording, refuse, succeed, tree, write_events};
use serde_json::{Value, json};
use std::{fs, path::Path};

/// Options with which a short event takes a moment.
const QUICK: [&str; 4] = ["--simulations", "10", "--simulations-open-loop", "10"];

fn check<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["check-minds", "--events", "events.json"], more, &QUICK[..]].concat()
}

/// Nobody moves for four steps; agent 0 is where it wants to be, agent 1 is not.
fn still() -> Value {
    recording("still")
}

/// Agent 1 walks 0.2 u in each of the four steps; else as [`still`].
fn walking() -> Value {
    let mut walking = recording("walking");
    for (step, row) in walking["trajectory"]["agents"][1].as_array_mut().expect("rows").iter_mut().enumerate()
    {
        row[1] = json!(8.0 + 0.2 * step as f64);
    }
    walking
}

fn folder(events: &[Value]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    write_events(&folder.path().join("events.json"), events);
    folder
}

fn report(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).expect("a report")).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Removes what was measured with a clock.
fn without_cpu(value: &mut Value) {
    match value {
        Value::Object(members) => {
            members.retain(|name, _| !name.starts_with("cpu_seconds"));
            members.values_mut().for_each(without_cpu);
        }
        Value::Array(items) => items.iter_mut().for_each(without_cpu),
        _ => {}
    }
}

#[test]
fn recorded_motion_is_measured_as_by_hand() {
    let folder = folder(&[still(), walking()]);
    let path = folder.path();
    let table = succeed(path, &check(&["--json", "out.json"]));
    let rows = |name: &str| table.lines().filter(|line| line.starts_with(name)).count();
    assert_eq!((rows("all "), rows("independent "), rows("helping ")), (2, 2, 0), "{table}");
    let report = report(&path.join("out.json"));
    assert_eq!(report["format"], "phase-minds/1");
    assert_eq!((&report["events"], &report["decisions"]), (&json!(2), &json!(16)));
    let kinds = &report["kinds"];
    assert_eq!(kinds.as_object().expect("kinds").len(), 1);
    assert_eq!(kinds["independent"]["stray_per_step"], report["stray_per_step"]);
    let [still, walking] = [&report["each"][0], &report["each"][1]];
    assert_eq!((&still["id"], &still["kind"]), (&json!("still"), &json!("independent")));
    // A step lasts 1/12 s of physics and 0.25 s of video.
    let expected = [
        (still, "still_share_recorded", 1.0),
        (still, "explained_share", 1.0),
        (still, "path_recorded", 0.0),
        (still, "longest_still_with_open_goal_recorded", 1.0),
        (still, "contact_share_recorded", 0.0),
        (walking, "still_share_recorded", 0.0),
        (walking, "path_recorded", 0.8),
        (walking, "longest_still_with_open_goal_recorded", 0.0),
        (&report, "still_share_recorded", 0.5),
        (&report, "longest_still_with_open_goal_mean_recorded", 0.5),
    ];
    for (figures, name, value) in expected {
        assert!((number(&figures[name]) - value).abs() < 1e-5, "{name}: {} for {value}", figures[name]);
    }
    assert_eq!(still["path_ratio"], Value::Null, "nothing is to be divided by a path of length 0");
    assert_eq!(still["goals"], 2);
    assert_eq!(still["outcomes_as_each_other"], Value::Null, "of one seed there are no pairs");
    for name in ["choice_probability", "explained_share", "outcomes_as_recorded", "still_share"] {
        assert!((0.0..=1.0).contains(&number(&report[name])), "{name}: {}", report[name]);
    }
    // All steps of those who stay where they are are explained.
    assert_eq!(still["choice_probability_explained"], still["choice_probability"]);
    assert_eq!(still["log_likelihood_per_step_explained"], still["log_likelihood_per_step"]);
    // The lapse rate is that at which the likelihood is greatest.
    assert!(number(&report["log_likelihood_per_step"]) >= number(&report["log_likelihood_lapse_05"]) - 1e-9);
}

#[test]
fn whoever_is_where_it_wants_to_be_is_expected_to_stay() {
    let mut content = still();
    content["trajectory"]["agents"][1] = json!(vec![json!([23.5, 19.5, 0.0, 0.0, 0.5]); 5]);
    content["trajectory"]["objects"][0] = json!(vec![json!([15.0, 15.0, 0.0, 0.0, 0.0]); 5]);
    let folder = folder(&[content]);
    succeed(folder.path(), &check(&["--json", "out.json", "--open-loop-seeds", "3"]));
    let report = report(&folder.path().join("out.json"));
    for name in ["choice_probability", "outcomes_as_recorded", "outcomes_as_each_other", "still_share"] {
        assert!(number(&report[name]) > 0.9, "{name}: {}", report[name]);
    }
    assert!(number(&report["stray_per_step"]) < 0.05, "{}", report["stray_per_step"]);
    assert_eq!(number(&report["longest_still_with_open_goal"]), 0.0, "no goal is open");
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let folder = folder(&[still(), walking()]);
    let path = folder.path();
    let reports = ["1", "2"].map(|jobs| {
        let printed = succeed(path, &check(&["--jobs", jobs, "--json"]));
        let mut report: Value = serde_json::from_str(&printed).expect("one JSON object");
        without_cpu(&mut report);
        report
    });
    assert_eq!(reports[0], reports[1]);
}

#[test]
fn parameters_come_from_a_file() {
    let folder = folder(&[walking()]);
    let path = folder.path();
    fs::write(path.join("minds.json"), r#"{"lambda": 0.5, "particles": 7}"#).expect("written");
    let printed = succeed(path, &check(&["--parameters", "minds.json", "--json"]));
    let report: Value = serde_json::from_str(&printed).expect("one JSON object");
    for minds in [&report["run"]["observed"]["minds"], &report["run"]["open_loop"]["minds"]] {
        assert_eq!((&minds["lambda"], &minds["particles"]), (&json!(0.5), &json!(7)));
        assert_eq!(minds["simulations"], 10);
    }
    let cases = [
        ("", "minds.json"),
        ("[1]", "must be an object"),
        (r#"{"lamda": 0.5}"#, "`lamda`"),
        (r#"{"lambda": "much"}"#, "much"),
        (r#"{"particles": 0}"#, "`particles`"),
        (r#"{"searches": 2}"#, "`searches` is a parameter of published minds, not of phase minds"),
    ];
    for (content, said) in cases {
        fs::write(path.join("minds.json"), content).expect("written");
        let sentence = refuse(path, &check(&["--parameters", "minds.json"]));
        assert!(sentence.contains("minds.json") && sentence.contains(said), "{sentence}");
    }
}

#[test]
fn rubbish_is_refused_in_one_sentence() {
    let folder = folder(&[still()]);
    let path = folder.path();
    let before = tree(path);
    let cases: [(&[&str], &str); 6] = [
        (&["--only", "dancing"], "dancing"),
        (&["--only", "chasing"], "no events of the kind chasing"),
        (&["--simulations", "0"], "--simulations"),
        (&["--json", "events.json"], "input file"),
        (&["--json", "no/such/out.json"], "folder does not exist"),
        (&["--parameters", "missing.json"], "missing.json"),
    ];
    for (arguments, said) in cases {
        let sentence = refuse(path, &[&["check-minds", "--events", "events.json"], arguments].concat());
        assert!(sentence.contains(said), "{sentence}");
    }
    assert_eq!(tree(path), before);
    let mut start = still();
    for group in ["agents", "objects"] {
        for rows in start["trajectory"][group].as_array_mut().expect("entities") {
            rows.as_array_mut().expect("rows").truncate(1);
        }
    }
    write_events(&path.join("events.json"), &[start]);
    assert!(refuse(path, &check(&[])).contains("only one row"));
    for rubbish in ["", "{", "rubbish", "[1, 2]", "{\"format\": \"phase-events/1\"}"] {
        fs::write(path.join("events.json"), rubbish).expect("written");
        assert!(refuse(path, &check(&[])).contains("events.json"), "{rubbish}");
    }
}

#[test]
fn published_minds_turn_one_way_in_recordings() {
    let folder = folder(&[still(), walking()]);
    let path = folder.path();
    let more = ["--minds", "published", "--ids", "still", "--json", "out.json"];
    succeed(path, &check(&more));
    let report = report(&path.join("out.json"));
    assert_eq!((&report["events"], &report["run"]["minds"]), (&json!(1), &json!("published")));
    let agents = &report["run"]["observed"];
    let minds = &agents["minds"];
    assert_eq!((&minds["kind"], &agents["one_way_turns"]), (&json!("published"), &json!(true)));
    assert_eq!((&minds["simulations"], &minds["searches"]), (&json!(10), &json!(5)));
    let refused = refuse(path, &check(&["--searches", "2"]));
    assert!(refused.contains("--searches: phase minds search once a decision"), "{refused}");
    let refused = refuse(path, &check(&["--ids", "nobody"]));
    assert!(refused.contains("has no event \"nobody\""), "{refused}");
}
