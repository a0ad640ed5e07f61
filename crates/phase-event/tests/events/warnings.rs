//! Misspelt members are errors; suspicious values are warnings.

use crate::support::{file, plain_event};
use phase_event::{EventWarning, Recording, from_json};
use phase_model::Relation;
use serde_json::{Value, json};

/// The message about an event with one more member in the object that the pointer refers to.
fn with_member(of: &Value, pointer: &str, key: &str) -> String {
    let mut value = of.clone();
    let object = value.pointer_mut(pointer).and_then(Value::as_object_mut).expect(pointer);
    object.insert(key.into(), json!(1));
    from_json(&value.to_string()).expect_err(key).to_string()
}

#[test]
fn misspelt_members_are_named_at_every_level_with_what_was_meant() {
    let recording = Recording::of_event("event-1", plain_event(2), "phase test".into(), json!({}));
    let simulated = json!({"format": "phase-events/1", "events": [recording]});
    let measured = file();
    let cases = [
        (&measured, "", "event", "field `event` is unknown; did you mean `events`?"),
        (
            &measured,
            "/events/0",
            "agent",
            "event made-up-1: field `agent` is unknown; did you mean `agents`?",
        ),
        (&measured, "/events/0", "sede", "event made-up-1: field `sede` is unknown; did you mean `seed`?"),
        (&measured, "/events/0", "Trajectory", "field `Trajectory` is unknown; did you mean `trajectory`?"),
        (&measured, "/events/0", "relation-human", "did you mean `relation_human`?"),
        (&measured, "/events/0/layout", "flipp", "field `layout.flipp` is unknown; did you mean `flip`?"),
        (&measured, "/events/0/agents/1", "size", "field `agents[1].size` is unknown; expected are radius"),
        (
            &measured,
            "/events/0/agents/1",
            "maxforce",
            "`agents[1].maxforce` is unknown; did you mean `max_force`?",
        ),
        (&measured, "/events/0/agents/1", "start", "field `agents[1].start` is unknown"),
        (&measured, "/events/0/agents/0/goal", "sgin", "`agents[0].goal.sgin` is unknown; did you mean"),
        (
            &measured,
            "/events/0/objects/0",
            "size_levle",
            "`objects[0].size_levle` is unknown; did you mean `size_level`?",
        ),
        (&measured, "/events/0/trajectory", "agent", "`trajectory.agent` is unknown; did you mean `agents`?"),
        (
            &measured,
            "/events/0/recovered_actions",
            "step",
            "`recovered_actions.step` is unknown; did you mean",
        ),
        (&simulated, "/events/0", "subtsep", "event event-1: field `subtsep` is unknown"),
        (&simulated, "/events/0/substeps", "grip", "`substeps.grip` is unknown; did you mean `grips`?"),
        (
            &simulated,
            "/events/0/thoughts/0/1",
            "plans",
            "`thoughts[0][1].plans` is unknown; did you mean `plan`?",
        ),
        (
            &simulated,
            "/events/0/substeps/grips/1/1/1",
            "sied",
            "grips[1][1][1].sied` is unknown; did you mean",
        ),
    ];
    for (of, pointer, key, part) in cases {
        let sentence = with_member(of, pointer, key);
        assert!(sentence.contains(part), "{pointer}/{key}: {sentence}");
    }
}

#[test]
fn members_that_begin_with_an_underscore_are_left_alone() {
    let mut value = file();
    let good = from_json(&value.to_string()).expect("a good file");
    for pointer in ["", "/events/0", "/events/0/agents/0", "/events/0/trajectory"] {
        let object = value.pointer_mut(pointer).and_then(Value::as_object_mut).expect(pointer);
        object.insert("_comment".into(), json!("made by hand"));
    }
    assert_eq!(from_json(&value.to_string()), Ok(good));
}

#[test]
fn an_event_to_be_simulated_may_bring_its_seed() {
    let mut value = file();
    let without = from_json(&value.to_string()).expect("a good file").remove(0);
    assert_eq!(without.seed, None);
    value["events"][0]["seed"] = json!(u64::MAX);
    let with = from_json(&value.to_string()).expect("a good file").remove(0);
    assert_eq!(with.seed, Some(u64::MAX));
    assert_eq!(Recording::from_json(&with.to_json().expect("finite")), Ok(with));
    for (bad, shown) in [(json!(-1), "-1"), (json!(1.5), "1.5"), (json!("7"), "\"7\"")] {
        value["events"][0]["seed"] = bad;
        let sentence = from_json(&value.to_string()).expect_err(shown).to_string();
        assert!(sentence.contains("`seed`") && sentence.ends_with(shown), "{sentence}");
    }
    let simulated = Recording::of_event("event-1", plain_event(1), "phase test".into(), json!({}));
    assert_eq!(simulated.seed, None, "it stands in the event");
}

#[test]
fn labels_that_disagree_are_warned_of() {
    let mut recording = from_json(&file().to_string()).expect("a good file").remove(0);
    let describe = |recording: &Recording| -> Vec<String> {
        recording.warnings().iter().map(ToString::to_string).collect()
    };
    assert_eq!(recording.warnings(), []);
    recording.relation = Relation::Neutral;
    assert_eq!(
        describe(&recording),
        ["relation is \"neutral\", but goals and attitudes make it \"friendly\""]
    );
    recording.relation = Relation::Friendly;
    recording.recorded_steps = Some(1);
    assert_eq!(describe(&recording), ["recorded_steps is 1, but trajectory has 2 steps"]);
    recording.recorded_steps = None;
    recording.scene.objects[0].start.angle = 90.0;
    assert!(matches!(recording.warnings()[..], [EventWarning::Scene(_)]));
    let text = "trajectory.objects[0][0]: the angle 90 is in radians; 90 degrees are 1.5708 rad";
    assert_eq!(describe(&recording), [text]);
}

#[test]
fn helping_without_a_helper_is_an_error() {
    let mut value = file();
    value["events"][0]["agents"][0]["alpha"] = json!(0);
    let sentence = from_json(&value.to_string()).expect_err("nobody helps").to_string();
    let text = "event made-up-1: event is \"helping\", but no agent has the attitude `alpha` 1";
    assert_eq!(sentence, text);
}

/// An agent goes along the arena at 6 u/s of physics, half a unit a step; its file says this velocity.
fn walk(steps: usize, velocity: f32) -> Vec<EventWarning> {
    let mut value = file();
    let trajectory = &mut value["events"][0]["trajectory"];
    let standing = |x: f32, y: f32| vec![json!([x, y, 0, 0, 0]); 1 + steps];
    let row = |t: usize| json!([8.0 + 0.5 * t as f32, 14, velocity, 0, 0]);
    trajectory["agents"] = json!([(0..=steps).map(row).collect::<Vec<_>>(), standing(12.0, 5.0)]);
    trajectory["objects"] = json!([standing(20.0, 20.0)]);
    value["events"][0]["recorded_steps"] = steps.into();
    value["events"][0].as_object_mut().expect("an event").remove("recovered_actions");
    let recording = &from_json(&value.to_string()).expect("a good file")[0];
    let of_motion = |warning: &EventWarning| matches!(warning, EventWarning::Velocities { .. });
    let warnings: Vec<EventWarning> = recording.warnings().into_iter().filter(of_motion).collect();
    assert_eq!(recording.observed().expect("is sound").warnings(), warnings);
    warnings
}

#[test]
fn rows_that_no_body_can_have_are_refused() {
    for (column, number) in [(2, 340.0), (4, 1e6)] {
        let mut value = file();
        value["events"][0]["trajectory"]["agents"][0][2][column] = json!(number);
        let told = from_json(&value.to_string()).expect_err("refused").to_string();
        let rule = "must not be faster than 339 u/s, and its angle must be within 100000 rad";
        assert!(told.contains("`trajectory.agents[0][2]`") && told.contains(rule), "{told}");
    }
}

#[test]
fn velocities_are_per_second_of_physics() {
    assert_eq!(walk(20, 6.0), []);
    let of_video = walk(20, 2.0);
    assert_eq!(
        of_video.iter().map(ToString::to_string).collect::<Vec<_>>(),
        ["trajectory: bodies move 10.0 u in all, but their velocities say 3.3 u; vx and vy are per second \
          of physics, of which a step lasts 1/12"]
    );
    assert_eq!(walk(20, 0.0).len(), 1);
    assert_eq!(walk(8, 2.0), [], "4 u are too few to tell");
}
