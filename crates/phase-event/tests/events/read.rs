//! The rules for files, and the messages for files that violate them.

use crate::support::file;
use phase_event::{EventReadError, Recording, parse, parse_observed};
use phase_model::{
    Action, Attitude, EventKind, Goal, LandmarkId, ObjectId, Relation, Sign, Size, Strength, Vec2,
    json::JsonError,
};
use serde_json::{Value, json};

fn parse_value(value: &Value) -> Result<Vec<Recording>, EventReadError> {
    parse(value.to_string().as_bytes())
}

#[test]
fn every_field_arrives() {
    let recordings = parse_value(&file()).expect("a good file");
    assert_eq!(recordings.len(), 1);
    let recording = &recordings[0];
    let scene = &recording.scene;
    assert_eq!(recording.id, "made-up-1");
    assert_eq!((scene.layout.base(), scene.layout.flip().map(u8::from)), (4, Some(2)));
    assert_eq!(scene.kind, EventKind::Helping);
    assert_eq!(recording.relation, Relation::Friendly);
    assert_eq!(recording.relation_human, Some(Relation::Neutral));
    assert_eq!(recording.row_0.as_deref(), Some("after 1/60 s"));
    assert_eq!(recording.recorded_steps, Some(100));
    let [first, second] = scene.agents;
    assert_eq!((first.size, first.strength, first.attitude), (Size::Small, Strength::Strong, Attitude::Help));
    let sizes = (second.size, second.strength, second.attitude);
    assert_eq!(sizes, (Size::Medium, Strength::Weak, Attitude::Neutral));
    assert_eq!(
        first.goal,
        Goal::ObjectOnLandmark {
            object: ObjectId::ZERO,
            landmark: LandmarkId::BOTTOM_RIGHT,
            sign: Sign::Positive
        }
    );
    assert_eq!(first.start.position, Vec2::new(8.0, 14.0));
    assert_eq!(first.start.velocity, Vec2::new(0.5, -0.25));
    assert_eq!(first.start.angle, 1.5);
    assert_eq!(scene.objects.len(), 1);
    assert_eq!(scene.objects[0].size, Size::Large);
    assert_eq!(scene.objects[0].start.position, Vec2::new(20.0, 14.0));
    assert_eq!(recording.trajectory.steps(), 2);
    assert_eq!(recording.trajectory.agents[1][2], [12.25, 14.0, 0.5, -0.25, 1.5]);
    let recovered = recording.recovered_actions.as_ref().expect("recovered actions");
    assert_eq!(recovered.steps, [[Action::Up, Action::NoForce], [Action::Attach, Action::TurnLeft]]);
    assert!(recording.simulation.is_none());
}

#[test]
fn a_viewer_needs_no_labels() {
    let seen = parse_observed(file().to_string().as_bytes()).expect("a good file");
    let recording = &parse_value(&file()).expect("a good file")[0];
    assert_eq!(seen, [("made-up-1".to_owned(), recording.observed().expect("is sound"))]);
    let mut value = file();
    let event = value["events"][0].as_object_mut().expect("an event");
    ["event", "relation", "relation_human", "recovered_actions"].iter().for_each(|key| {
        event.remove(*key).expect("a label");
    });
    for agent in event["agents"].as_array_mut().expect("agents") {
        let agent = agent.as_object_mut().expect("an agent");
        ["goal", "alpha", "strength_level"].iter().for_each(|key| {
            agent.remove(*key).expect("a label");
        });
        agent.remove("max_force");
    }
    assert_eq!(parse_observed(value.to_string().as_bytes()), Ok(seen));
    // What can be seen is checked as ever.
    value["events"][0]["trajectory"]["agents"][1][0][0] = json!(40);
    let error = parse_observed(value.to_string().as_bytes()).expect_err("outside the arena").to_string();
    assert!(error.contains("made-up-1") && error.contains("trajectory.agents[1][0]"), "{error}");
    value["events"][0]["agents"][0]["size_level"] = json!(7);
    let error = parse_observed(value.to_string().as_bytes()).expect_err("no such size").to_string();
    assert!(error.contains("agents[0].size_level"), "{error}");
}

#[test]
fn what_is_optional_may_be_absent() {
    let mut value = file();
    let event = value["events"][0].as_object_mut().expect("an event");
    for key in [
        "walls",
        "landmarks",
        "relation",
        "relation_human",
        "step_seconds",
        "row_0",
        "recorded_steps",
        "recovered_actions",
    ] {
        event.remove(key).expect("a field of the example");
    }
    event["agents"][0].as_object_mut().expect("an agent").remove("radius");
    event.insert("_added_by_someone".into(), json!({"else": true}));
    let recordings = parse_value(&value).expect("a good file");
    assert_eq!(recordings[0].relation, Relation::Friendly, "follows from the goals");
}

#[test]
fn walls_may_be_listed_in_any_order_and_direction() {
    let mut value = file();
    value["events"][0]["walls"] = json!([[[16.0, 4.5], [16.0, 12.0]], [[26.0, 12.0], [16.0, 12.0]]]);
    parse_value(&value).expect("the same walls");
}

/// A change to the valid file, and the expected content of the error message.
#[test]
fn every_rule_names_event_field_and_rule() {
    let agent_goal = "/events/0/agents/0/goal";
    let cases: &[(&str, Value, &[&str])] = &[
        ("/format", json!("phase-events/2"), &["`format`", "\"phase-events/1\"", "\"phase-events/2\""]),
        ("/events", json!([]), &["`events`", "at least one"]),
        ("/events", json!({}), &["`events`", "an array"]),
        ("/events/0", json!(3), &["an object, not 3"]),
        ("/events/0/id", json!(7), &["event number 0", "`id`", "a text, not 7"]),
        ("/events/0/id", json!("../escape"), &["`id`", "../escape"]),
        ("/events/0/id", json!(""), &["`id`", "1 to 100"]),
        ("/events/0/id", json!(".hidden"), &["`id`"]),
        ("/events/0/layout/base", json!(22), &["made-up-1", "`layout.base`", "0 to 21", "22"]),
        ("/events/0/layout/base", json!(-1), &["`layout.base`", "-1"]),
        ("/events/0/layout/flip", json!(4), &["`layout.flip`", "0 to 3", "4"]),
        ("/events/0/layout", json!({"base": 4, "flap": 2}), &["`layout.flap`", "unknown"]),
        ("/events/0/layout", json!({"flip": 2}), &["`layout.base`", "missing"]),
        ("/events/0/walls", json!([]), &["`walls`", "base 4, flip 2"]),
        ("/events/0/walls/0/0/0", json!(15.0), &["`walls`", "base 4, flip 2"]),
        ("/events/0/walls/0", json!([1.0, 2.0]), &["`walls[0][0]`", "an array"]),
        ("/events/0/landmarks/2", json!([8.5, 19.5]), &["`landmarks`", "(23.5, 4.5)"]),
        ("/events/0/agents", json!([]), &["`agents`", "2 agents, not 0"]),
        ("/events/0/agents/0/radius", json!(-0.8), &["`agents[0].radius`", "0.8", "-0.8"]),
        ("/events/0/agents/0/radius", json!(1.2), &["`agents[0].radius`", "size_level 0"]),
        ("/events/0/agents/0/radius", json!("big"), &["`agents[0].radius`", "finite number", "\"big\""]),
        ("/events/0/agents/1/size_level", json!(4), &["`agents[1].size_level`", "0 to 3"]),
        ("/events/0/agents/1/size_level", json!(-3), &["`agents[1].size_level`", "-3"]),
        ("/events/0/agents/1/size_level", json!(1.5), &["`agents[1].size_level`", "whole number"]),
        ("/events/0/agents/0/max_force", json!(451.0), &["`agents[0].max_force`", "450", "strength_level 2"]),
        ("/events/0/agents/0/strength_level", json!(null), &["`agents[0].strength_level`", "null"]),
        ("/events/0/agents/0/alpha", json!(2), &["`agents[0].alpha`", "-1 to 1"]),
        ("/events/0/agents/0/alpha", json!(0.5), &["`agents[0].alpha`"]),
        ("/events/0/agents/1/alpha", json!(1), &["at most one agent"]),
        ("/events/0/agents/0/alpha", json!(-1), &["agents[0].goal", "hindering", "opposite sign"]),
        (&format!("{agent_goal}/sign"), json!(0), &["`agents[0].goal.sign`", "1 or -1", "0"]),
        (&format!("{agent_goal}/kind"), json!("sing"), &["`agents[0].goal.kind`", "touch", "\"sing\""]),
        (&format!("{agent_goal}/object"), json!(1), &["agents[0].goal", "object 1", "only 1"]),
        (&format!("{agent_goal}/landmark"), json!(4), &["agents[0].goal.landmark", "from 0 to 3", "not 4"]),
        (&format!("{agent_goal}/landmark"), json!(-1), &["`agents[0].goal.landmark`", "-1"]),
        (agent_goal, json!(null), &["`agents[0].goal`", "an object, not null"]),
        (
            agent_goal,
            json!({"kind": "touch", "agent": 0, "other": 0, "sign": 1}),
            &["agents[0].goal", "cannot touch itself"],
        ),
        ("/events/0/objects/0/radius", json!(-1.2), &["`objects[0].radius`", "-1.2"]),
        (
            "/events/0/objects",
            json!([{"size_level": 0}, {"size_level": 0}, {"size_level": 0}]),
            &["`objects`", "at most 2"],
        ),
        ("/events/0/event", json!("dancing"), &["`event`", "helping", "\"dancing\""]),
        ("/events/0/relation", json!("cool"), &["`relation`", "friendly", "\"cool\""]),
        ("/events/0/relation_human", json!(3), &["`relation_human`"]),
        ("/events/0/step_seconds", json!(0.1), &["`step_seconds`", "0.25", "0.1"]),
        ("/events/0/recorded_steps", json!(-4), &["`recorded_steps`", "-4"]),
        ("/events/0/trajectory/columns/4", json!("theta"), &["`trajectory.columns`", "angle"]),
        ("/events/0/trajectory/agents", json!([]), &["`trajectory.agents`", "2 tracks"]),
        ("/events/0/trajectory/objects", json!([]), &["`trajectory.objects`", "1 tracks"]),
        ("/events/0/trajectory/agents/0", json!([]), &["`trajectory.agents[0]`", "at least one row"]),
        (
            "/events/0/trajectory/agents/1/2",
            json!([1.0, 2.0]),
            &["`trajectory.agents[1][2]`", "5 numbers, not 2"],
        ),
        ("/events/0/trajectory/agents/1/2", json!(null), &["`trajectory.agents[1][2]`", "not null"]),
        (
            "/events/0/trajectory/agents/1/2/3",
            json!(null),
            &["`trajectory.agents[1][2][3]`", "finite", "null"],
        ),
        ("/events/0/trajectory/agents/1/2/3", json!(1e300), &["`trajectory.agents[1][2][3]`", "finite"]),
        ("/events/0/trajectory/agents/0/0/0", json!(5.9), &["`trajectory.agents[0][0]`", "inside the arena"]),
        (
            "/events/0/trajectory/objects/0/1/1",
            json!(99),
            &["`trajectory.objects[0][1]`", "inside the arena"],
        ),
        (
            "/events/0/trajectory/objects/0",
            json!([[20.0, 14.0, 0.0, 0.0, 0.0]]),
            &["`trajectory.objects[0]`", "1 rows", "has 3"],
        ),
        (
            "/events/0/recovered_actions/steps/1/0",
            json!("jump"),
            &["`recovered_actions.steps[1][0]`", "jump"],
        ),
        (
            "/events/0/recovered_actions/steps/1",
            json!(["up"]),
            &["`recovered_actions.steps[1]`", "two actions"],
        ),
        (
            "/events/0/recovered_actions/steps",
            json!([["up", "up"], ["up", "up"], ["up", "up"]]),
            &["`recovered_actions.steps`", "at most the 2 steps", "not 3"],
        ),
    ];
    for (pointer, replacement, expected) in cases {
        let mut value = file();
        *value.pointer_mut(pointer).expect(pointer) = replacement.clone();
        let problem = parse_value(&value).expect_err(pointer);
        let sentence = problem.to_string();
        for part in *expected {
            assert!(sentence.contains(part), "{pointer} = {replacement}: {part:?} is not in {sentence:?}");
        }
        assert!(
            !sentence.contains('\n') && sentence.len() < 250,
            "{pointer}: not one sentence: {sentence:?}"
        );
    }
}

#[test]
fn every_field_that_must_be_there_is_missed() {
    let required = [
        "/id",
        "/layout",
        "/agents",
        "/objects",
        "/event",
        "/trajectory",
        "/trajectory/columns",
        "/agents/0/goal",
        "/agents/1/alpha",
        "/agents/0/size_level",
        "/objects/0/size_level",
        "/agents/0/goal/kind",
        "/agents/0/goal/landmark",
    ];
    for pointer in required {
        let mut value = file();
        let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
        let parent = value.pointer_mut(&format!("/events/0{parent}")).expect(pointer);
        parent.as_object_mut().expect(pointer).remove(key).expect(pointer);
        let sentence = parse_value(&value).expect_err(pointer).to_string();
        let field = pointer[1..].replace("/0/", "[0].").replace("/1/", "[1].").replace('/', ".");
        assert!(sentence.contains(&format!("`{field}` is missing")), "{pointer}: {sentence}");
    }
}

#[test]
fn two_events_need_two_names() {
    let mut value = file();
    let event = value["events"][0].clone();
    value["events"].as_array_mut().expect("events").push(event);
    assert_eq!(parse_value(&value), Err(EventReadError::DuplicateId("made-up-1".into())));
    // Some systems take these for the same file.
    value["events"][1]["id"] = "Made-Up-1".into();
    assert_eq!(parse_value(&value), Err(EventReadError::DuplicateId("Made-Up-1".into())));
}

/// Names of files that some systems refuse, or take for something else.
#[test]
fn ids_are_names_of_files_on_every_system() {
    for id in ["CON", "aux", "nul.json", "Com1", "lpt9.a", "a.", "..", "-a", "a b", "a/b", "a:b", "ä"] {
        let mut value = file();
        value["events"][0]["id"] = id.into();
        let sentence = parse_value(&value).expect_err(id).to_string();
        assert!(sentence.contains("field `id` must "), "{id}: {sentence}");
    }
    for id in ["CONTROL", "auxiliary", "nul-1", "com10", "a.b"] {
        let mut value = file();
        value["events"][0]["id"] = id.into();
        assert!(parse_value(&value).is_ok(), "{id}");
    }
}

#[test]
fn text_that_is_no_json_is_called_what_it_is() {
    let good = serde_json::to_string_pretty(&file()).expect("text");
    let with = |from: &str, to: &str| {
        assert!(good.contains(from), "{from}");
        good.replacen(from, to, 1)
    };
    let line_of = |text: &str, part: &str| text[..text.find(part).expect(part)].lines().count();
    let truncated = &good[..good.len() / 2];
    assert_eq!(parse(truncated.as_bytes()), Err(JsonError::Truncated(truncated.lines().count()).into()));

    for token in ["NaN", "Infinity", "-Infinity"] {
        let text = with("450.0", token);
        let line = line_of(&text, token);
        assert_eq!(parse(text.as_bytes()), Err(JsonError::NotANumber { token: token.into(), line }.into()));
    }
    let text = with("450.0", "1e999");
    assert_eq!(parse(text.as_bytes()), Err(JsonError::NumberTooLarge(line_of(&text, "1e999")).into()));

    assert_eq!(parse(b""), Err(JsonError::Empty.into()));
    assert_eq!(parse(b" \n "), Err(JsonError::Empty.into()));
    assert_eq!(parse(b"\0\0\0\x20ftypisom\xff\xfe"), Err(JsonError::NotText(12).into()));
    assert!(matches!(
        parse(b"id,x,y\n1,2,3\n"),
        Err(EventReadError::Json(JsonError::NotJson { line: 1, .. }))
    ));
    assert!(matches!(parse(b"[]"), Err(EventReadError::Json(JsonError::Format { .. }))));
    assert!(matches!(parse(b"{}"), Err(EventReadError::Json(JsonError::Format { .. }))));
}

#[test]
fn a_deep_file_is_an_error_and_no_overflow() {
    let text = "[".repeat(1_000_000);
    assert!(matches!(parse(text.as_bytes()), Err(EventReadError::Json(JsonError::NotJson { .. }))));
}
