//! Reading and writing are exact inverses, bit for bit.

use crate::support::{event, file, plain_event};
use phase_event::{Controller, Recording, Trajectory, parse, subgoal_of, to_json};
use phase_model::{
    AgentId, Entity, LandmarkId, Literal, ObjectId, Predicate, PredicateTarget, Subgoal, arena::SUBSTEPS,
};
use proptest::prelude::*;
use serde_json::{Value, json};

fn recording(steps: usize) -> Recording {
    Recording::of_event("event-1", plain_event(steps), "phase test".into(), json!({"max_steps": 3}))
}

/// The number of frames of an event with this many steps.
const fn frames(steps: usize) -> usize {
    1 + steps * SUBSTEPS
}

#[test]
fn a_simulated_event_comes_back_whole() {
    for steps in [0, 1, 4] {
        let original = recording(steps);
        let text = to_json(std::slice::from_ref(&original)).expect("finite");
        let read = parse(text.as_bytes()).expect("our own file");
        assert_eq!(read, [original], "{steps} steps");
    }
}

#[test]
fn a_measured_recording_comes_back_whole() {
    let read = parse(file().to_string().as_bytes()).expect("a good file");
    let text = to_json(&read).expect("finite");
    assert_eq!(parse(text.as_bytes()).expect("our own file"), read);
}

/// The controller is written of agents that people moved; a scene does not say it.
#[test]
fn controllers_come_back() {
    let controllers = [Controller::Mind, Controller::Human];
    let original = Recording { controllers, ..recording(1) };
    let text = to_json(std::slice::from_ref(&original)).expect("finite");
    let mut value: Value = serde_json::from_str(&text).expect("JSON");
    let agents = value["events"][0]["agents"].as_array_mut().expect("agents");
    assert_eq!((agents[0].get("controller"), &agents[1]["controller"]), (None, &json!("human")));
    assert_eq!(parse(text.as_bytes()).expect("our own file"), [original]);
    agents[0]["controller"] = "robot".into();
    let refused = parse(value.to_string().as_bytes()).expect_err("no such controller").to_string();
    assert!(refused.contains("agents[0].controller") && refused.contains("human"), "{refused}");
    let mut scene: Value =
        serde_json::from_str(&plain_event(1).scene.to_json().expect("finite")).expect("JSON");
    scene["agents"][0]["controller"] = "human".into();
    assert!(phase_model::Scene::from_json(&scene.to_string()).is_err());
}

#[test]
fn several_events_share_a_file() {
    let both = [recording(1), Recording { id: "event-2".into(), ..recording(2) }];
    let text = to_json(&both).expect("finite");
    assert_eq!(parse(text.as_bytes()).expect("our own file"), both);
}

#[test]
fn rows_are_means_over_substeps() {
    let event = plain_event(3);
    let rows = Trajectory::means(&event);
    for (entity, rows) in rows.entities().enumerate() {
        assert_eq!(rows.len(), 4);
        assert_eq!(rows[0][0], event.initial.bodies[entity].position.x);
        for (t, step) in event.steps.iter().enumerate() {
            let mean = |column: fn(&phase_model::Body) -> f32| {
                let sum: f64 =
                    step.substeps.iter().map(|state| f64::from(column(&state.bodies[entity]))).sum();
                (sum / 5.0) as f32
            };
            let expected = [
                mean(|body| body.position.x),
                mean(|body| body.position.y),
                mean(|body| body.velocity.x),
                mean(|body| body.velocity.y),
                mean(|body| body.angle),
            ];
            assert_eq!(rows[t + 1], expected, "entity {entity}, step {t}");
        }
    }
}

/// The file structure that other programs rely on, checked without our reader.
#[test]
fn the_file_is_as_documented() {
    let steps = 3;
    let text = to_json(&[recording(steps)]).expect("finite");
    let value: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(value["format"], "phase-events/1");
    let event = &value["events"][0];
    assert_eq!(event["seed"], json!(u64::MAX - 3));
    assert_eq!(event["row_0"], "initial state");
    assert_eq!(event["recorded_steps"], steps);
    assert_eq!(event["relation"], "friendly");
    assert_eq!(event["agents"][0]["alpha"], 1);
    assert_eq!(event["agents"][0]["max_force"], 450.0);
    assert_eq!(event["layout"], json!({"base": 20, "flip": 3}));
    assert_eq!(event["actions"][0], json!(["turnleft", "right"]));
    assert_eq!(event["subgoals"][0], json!(["Attach(agent 0, object 1)", "Stay"]));
    assert_eq!(event["subgoals"][1][0], "not Touch(agent 0, agent 1)");
    assert_eq!(event["values"][0][0], event["thoughts"][0][0]["subgoals"][0][1]);
    assert_eq!(event["values"][0][1], Value::Null, "nobody proposed to stay");
    let substeps = &event["substeps"];
    assert_eq!(substeps["columns"], json!(["x", "y", "vx", "vy", "angle", "angular_velocity"]));
    for track in [&substeps["agents"][1], &substeps["objects"][0]] {
        assert_eq!(track.as_array().map(Vec::len), Some(frames(steps)));
    }
    // Step 1, substep 2 is frame 1 + 5 + 2.
    assert_eq!(substeps["grips"][0], json!([0, [null, null]]));
    assert_eq!(substeps["grips"][1][0], 1 + SUBSTEPS + 2);
    assert_eq!(substeps["grips"][1][1][1]["side"], "tail");
    assert_eq!(substeps["contacts"][1], json!([4, [[0, 2]]]));
}

#[test]
fn numbers_that_json_cannot_hold_are_refused() {
    for spoil in [f32::NAN, f32::INFINITY] {
        let mut event = plain_event(2);
        event.steps[1].substeps[4].bodies[0].velocity.x = spoil;
        let recording = Recording::of_event("spoilt", event, "phase test".into(), json!({}));
        let error = to_json(&[recording]).expect_err("not finite");
        assert!(error.to_string().contains("spoilt"));
    }
}

#[test]
fn a_simulation_that_does_not_fit_together_is_refused() {
    let text = to_json(&[recording(2)]).expect("finite");
    let good: Value = serde_json::from_str(&text).expect("JSON");
    let cases: &[(&str, Value, &str)] = &[
        ("/events/0/seed", json!(-1), "`seed`"),
        ("/events/0/actions", json!([]), "`actions`"),
        ("/events/0/actions/0/1", json!("fly"), "`actions[0][1]`"),
        ("/events/0/subgoals/1/0", json!("Dance(agent 0)"), "`subgoals[1][0]`"),
        ("/events/0/subgoals/1", json!(["Stay"]), "thoughts"),
        ("/events/0/values/0/0", json!(0.123), "`values[0]`"),
        ("/events/0/values/0/1", json!(0.5), "`values[0]`"),
        ("/events/0/values/1", json!([null]), "`values[1]`"),
        ("/events/0/values", json!([]), "`values`"),
        ("/events/0/thoughts/0/0/plan/0", json!(7), "`thoughts[0][0].plan[0]`"),
        ("/events/0/thoughts/0/0/actions/3/1", json!(-1), "`thoughts[0][0].actions[3][1]`"),
        ("/events/0/thoughts/0/0/suspicion", json!(1.5), "`thoughts[0][0].suspicion`"),
        ("/events/0/substeps/agents/0", json!([]), "`substeps.agents[0]`"),
        ("/events/0/substeps/agents/0/3/0", json!(null), "`substeps.agents[0][3][0]`"),
        ("/events/0/substeps/objects", json!([]), "`substeps.objects`"),
        ("/events/0/substeps/grips", json!([]), "`substeps.grips`"),
        ("/events/0/substeps/grips/0/0", json!(1), "`substeps.grips[0][0]`"),
        ("/events/0/substeps/grips/1/0", json!(99), "`substeps.grips[1][0]`"),
        ("/events/0/substeps/grips/1/1/1/object", json!(2), "`substeps.grips[1][1][1].object`"),
        ("/events/0/substeps/contacts/1/1/0", json!([0, 0]), "`substeps.contacts[1][1][0]`"),
        ("/events/0/trajectory/agents/0/1/0", json!(7.0), "`trajectory`"),
    ];
    for (pointer, replacement, field) in cases {
        let mut value = good.clone();
        *value.pointer_mut(pointer).expect(pointer) = replacement.clone();
        let sentence = parse(value.to_string().as_bytes()).expect_err(pointer).to_string();
        assert!(sentence.contains(field) && sentence.contains("event-1"), "{pointer}: {sentence}");
    }
}

#[test]
fn subgoals_are_read_as_they_are_written() {
    let all = [
        Subgoal::Stay,
        Subgoal::Achieve(Literal::is(Predicate::On(Entity::Agent(AgentId::ONE), LandmarkId::BOTTOM_LEFT))),
        Subgoal::Achieve(Literal::not(Predicate::On(Entity::Object(ObjectId::ZERO), LandmarkId::TOP_LEFT))),
        Subgoal::Achieve(Literal::is(Predicate::Touch(AgentId::ONE, Entity::Agent(AgentId::ZERO)))),
        Subgoal::Achieve(Literal::not(Predicate::Attach(AgentId::ZERO, ObjectId::ONE))),
        Subgoal::Achieve(Literal::is(Predicate::Close(
            Entity::Agent(AgentId::ZERO),
            PredicateTarget::Landmark(LandmarkId::BOTTOM_RIGHT),
        ))),
        Subgoal::Achieve(Literal::is(Predicate::Close(
            Entity::Agent(AgentId::ZERO),
            PredicateTarget::Entity(Entity::Object(ObjectId::ONE)),
        ))),
    ];
    for subgoal in all {
        assert_eq!(subgoal_of(&subgoal.to_string()), Some(subgoal));
    }
    for text in ["", "stay", "On(agent 2, landmark 0)", "Attach(agent 0, object 1"] {
        assert_eq!(subgoal_of(text), None, "{text}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn any_finite_event_comes_back_to_the_bit(numbers in prop::collection::vec(0.0_f32..1.0, 50..200)) {
        let mut numbers = numbers.into_iter().cycle();
        let made = event(3, || numbers.next().unwrap_or_default());
        let original = Recording::of_event("any", made, "phase test".into(), json!({}));
        let text = to_json(std::slice::from_ref(&original)).expect("finite");
        let read = parse(text.as_bytes()).expect("our own file");
        let bits = |recording: &Recording| -> Vec<u32> {
            let event = &recording.simulation.as_ref().expect("a simulation").event;
            let bodies = event.frames().flat_map(|state| state.bodies);
            let numbers = |body: phase_model::Body| [body.position.x, body.velocity.y, body.angle];
            bodies.take(4 * 16).flat_map(numbers).map(f32::to_bits).collect()
        };
        prop_assert_eq!(bits(&read[0]), bits(&original));
        prop_assert_eq!(&read[0], &original);
    }
}
