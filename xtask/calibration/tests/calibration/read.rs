use crate::support::{probe, probes, run, runs};
use phase_calibration::{Probe, ReadError, Run};
use phase_model::{Action, AgentId, ObjectId};
use serde_json::{Value, json};

#[test]
fn good_files_are_read() {
    let mut held = run("two", 2);
    held["attached_after_step"] = json!([[null, 1], [0, 0]]);
    let runs = Run::parse(&runs(&[run("one", 1), held])).expect("runs");
    assert_eq!(runs[1].actions, [[Action::Stop, Action::NoForce]; 2]);
    assert_eq!(
        runs[1].states.iter().map(|state| state.held_object(AgentId::ONE)).collect::<Vec<_>>(),
        [None, Some(ObjectId::ONE), Some(ObjectId::ZERO)]
    );
    let probes = Probe::parse(&probes(&[probe("free_x")])).expect("probes");
    assert_eq!((probes[0].steps.len(), probes[0].substeps.len()), (2, 10));
    assert_eq!(probes[0].held, [[None, None], [None, Some(ObjectId::ZERO)]]);
    assert_eq!(probes[0].physics.object_radii, [0.8, 1.6]);
}

/// A change to a valid entry, and the expected content of the error message.
type Case = (&'static str, Value, &'static [&'static str]);

fn check(kind: &str, good: &Value, cases: &[Case], parse: impl Fn(&str) -> Option<ReadError>) {
    for (pointer, replacement, expected) in cases {
        let mut entry = good.clone();
        *entry.pointer_mut(pointer).expect(pointer) = replacement.clone();
        let text = json!({ kind: [entry] }).to_string();
        let sentence =
            parse(&text).unwrap_or_else(|| panic!("{pointer} = {replacement} is accepted")).to_string();
        for part in *expected {
            assert!(sentence.contains(part), "{pointer} = {replacement}: {part:?} is not in {sentence:?}");
        }
        assert!(!sentence.contains('\n') && sentence.len() < 400, "{sentence}");
    }
    for key in good.as_object().expect("an object").keys().filter(|key| *key != "init_velocities") {
        let mut entry = good.clone();
        entry.as_object_mut().expect("an object").remove(key);
        let sentence = parse(&json!({ kind: [entry] }).to_string()).expect(key).to_string();
        assert_eq!(sentence, format!("field `{kind}[0].{key}` is missing"));
    }
}

#[test]
fn every_rule_of_probes_names_field_and_rule() {
    let cases: &[Case] = &[
        ("/name", json!(3), &["`probes[0].name`", "text"]),
        ("/name", json!(""), &["`probes[0].name`", "one line"]),
        ("/wall_segs", json!([[[16, 12], [16, 12]]]), &["`probes[0].wall_segs`", "different ends"]),
        ("/wall_segs", json!([[[0, 12], [16, 12]]]), &["`probes[0].wall_segs`", "inside the arena"]),
        ("/wall_segs", json!(vec![[[16, 12], [16, 22]]; 5]), &["`probes[0].wall_segs`", "at most 4", "5"]),
        ("/sizes", json!([1, 1, 1]), &["`probes[0].sizes`", "four numbers"]),
        ("/sizes", json!([1, 1, 1, 0]), &["`probes[0].sizes`", "greater than 0"]),
        ("/sizes", json!([1, 1, 1, 1e60]), &["`probes[0].sizes`", "at most 10"]),
        ("/max_force", json!([-1, 1]), &["`probes[0].max_force`", "not negative"]),
        ("/actions/0/1", json!("jump"), &["`probes[0].actions`", "jump", "turnleft"]),
        ("/actions/0", json!(["up"]), &["`probes[0].actions`", "one length", "1 and 2"]),
        ("/actions", json!([[], []]), &["`probes[0].actions`", "at least 1"]),
        ("/actions", json!([["up", "up"]]), &["`probes[0].actions`", "two lists"]),
        ("/initial/2/0", json!(null), &["`probes[0].initial`", "null"]),
        ("/initial/2/3", json!(1e60), &["`probes[0].initial`", "body 2", "finite"]),
        ("/steps/1/3/1", json!(99), &["`probes[0].steps[1]`", "body 3", "2 to 22"]),
        ("/steps/1", json!([[0]]), &["`probes[0].steps`"]),
        ("/steps", json!([]), &["`probes[0].steps`", "2 in all, not 0"]),
        ("/substeps/3", json!([]), &["`probes[0].substeps`", "11 in all, not 0"]),
        ("/substeps/1/4/0", json!(-1), &["`probes[0].substeps[..][4]`", "body 1"]),
        (
            "/attached_after_step",
            json!([[null, null]]),
            &["`probes[0].attached_after_step`", "2 in all, not 1"],
        ),
        ("/attached_after_step/0/1", json!(2), &["`probes[0].attached_after_step`", "0, 1 or null"]),
        ("/attached_after_step/0/1", json!(-1), &["`probes[0].attached_after_step`"]),
        ("/init_velocities", json!([[1, 1]]), &["`probes[0].init_velocities`", "four bodies"]),
        (
            "/init_velocities",
            json!([null, null, null, [1, 1e60]]),
            &["`probes[0].init_velocities`", "finite"],
        ),
    ];
    check("probes", &probe("free_x"), cases, |text| Probe::parse(text).err());
}

#[test]
fn every_rule_of_runs_names_field_and_rule() {
    let cases: &[Case] = &[
        ("/walls", json!({}), &["`runs[0].walls`"]),
        ("/radii", json!([0.8, 0.8, 0.8, -0.8]), &["`runs[0].radii`", "greater than 0"]),
        ("/max_force", json!([1]), &["`runs[0].max_force`", "two numbers"]),
        ("/actions/1/0", json!(7), &["`runs[0].actions`"]),
        ("/states", json!([]), &["`runs[0].states`", "3 in all, not 0"]),
        ("/states/2/0/5", json!(1e39), &["`runs[0].states[2]`", "body 0", "finite"]),
        ("/states/2/0/5", json!("x"), &["`runs[0].states`", "four rows"]),
        ("/attached_after_step/1/0", json!(5), &["`runs[0].attached_after_step`", "0, 1 or null"]),
        ("/attached_after_step", json!([]), &["`runs[0].attached_after_step`", "2 in all"]),
    ];
    check("runs", &run("r", 2), cases, |text| Run::parse(text).err());
}

#[test]
fn files_of_another_kind_are_refused() {
    let good = probes(&[probe("a")]);
    let not_json =
        |text: &str| assert!(matches!(Probe::parse(text), Err(ReadError::NotJson(_))), "{text:.60}");
    not_json("");
    not_json(&good[..good.len() / 2]);
    not_json(&good.replacen("150", "NaN", 1));
    not_json(&good.replacen("150", "1e999", 1));
    not_json(&"[".repeat(100_000));
    let cases = [
        ("[]".to_owned(), "must be an object"),
        ("{}".to_owned(), "`probes` is missing"),
        (json!({"probes": 3}).to_string(), "`probes` must be a list"),
        (json!({"probes": []}).to_string(), "at least one"),
        (json!({"probes": [3]}).to_string(), "`probes[0]` must be an object"),
        (probes(&[probe("a"), probe("b"), probe("a")]), "`probes[2].name` must differ"),
        (runs(&[run("a", 1)]), "`probes` is missing"),
    ];
    for (text, expected) in cases {
        let sentence = Probe::parse(&text).expect_err(expected).to_string();
        assert!(sentence.contains(expected), "{expected:?} is not in {sentence:?}");
    }
}
