//! Configurations: what is taken, and what is refused in a sentence.

use crate::support::{document, forms, read};
use phase_study::{
    config::{GroupSize, StudyConfig, raters_needed},
    forms::{Form, GOALS, INTERACTIONS},
};
use proptest::prelude::*;
use serde_json::{Value, json};

#[test]
fn the_papers_labels_are_asked_in_its_order() {
    // Netanyahu et al., appendix, Experiment 1.
    let paper = "not interacting, interacting unintentionally, chasing, running away, stalking, approaching, avoiding, \
                 meeting, gathering together, guiding, following the lead (of another agent), playing a game of tag, \
                 blocking, fighting, competing, stealing, protecting an object, attacking, hindering, bullying, playing \
                 tug of war, helping, collaborating";
    let questions = forms().questions(Form::Interactions, 2);
    assert_eq!(questions.len(), 1);
    assert_eq!(questions[0].name, INTERACTIONS);
    let texts: Vec<&str> = questions[0].kind.choices().iter().map(|choice| choice.text.as_str()).collect();
    assert_eq!(texts, paper.split(", ").collect::<Vec<_>>());
    for objects in 0..=2 {
        let questions = forms().questions(Form::Goals, objects);
        let goals = questions.iter().find(|question| question.name == GOALS[0]).expect("asked");
        assert_eq!(goals.kind.choices().len(), 9 + 4 * usize::from(objects));
    }
}

#[test]
fn what_is_left_out_has_the_documented_value() {
    let config = read(&document(Form::Relation, 10, 3, 4));
    assert_eq!(config.parameters, ["PROLIFIC_PID", "STUDY_ID", "SESSION_ID"]);
    assert_eq!((config.raters_per_video_at_most, config.minutes, config.raters), (3, 60, 8));
    assert!(config.demographics.is_empty() && !config.between_sources && !config.identity_required);
    assert!(!config.one_of_each_set && !config.answer_before_end);
    assert_eq!((config.stimuli[0].source.as_str(), config.stimuli[0].objects), ("phase", 2));
}

#[test]
fn raters_needed_are_judgements_over_videos() {
    let all = |videos| GroupSize { videos, for_one: videos, fewest: 1 };
    assert_eq!(raters_needed(&[all(100)], 10, 8), 125);
    assert_eq!(raters_needed(&[all(100), all(100)], 18, 20), 180);
    // A rater who is to see more videos than there are sees all of them.
    assert_eq!(raters_needed(&[all(5)], 3, 20), 3);
    // Six videos in a set of four and a set of two: it takes four raters to see each once.
    assert_eq!(raters_needed(&[GroupSize { videos: 6, for_one: 2, fewest: 4 }], 5, 2), 20);
}

#[test]
fn mistakes_are_refused_with_field_and_rule() {
    let cases: &[(&str, Value, &[&str])] = &[
        ("/format", json!("phase-study/2"), &["`format`", "phase-study/1"]),
        ("/name", json!("A study"), &["`name`", "small letters"]),
        ("/name", json!("-"), &["`name`"]),
        ("/title", json!(""), &["`title`"]),
        ("/form", json!("mood"), &["`form`", "interactions, goals, relation"]),
        ("/consent", json!([]), &["`consent`", "at least one"]),
        ("/consent/0", json!(3), &["`consent[0]`", "text"]),
        ("/stimuli", json!([]), &["`stimuli`", "at least one"]),
        ("/stimuli/1/id", json!("event-0"), &["`stimuli`", "\"event-0\" twice"]),
        ("/stimuli/1/id", json!("a/b"), &["`stimuli[1].id`"]),
        ("/stimuli/1/video", json!("../secret.mp4"), &["`stimuli[1].video`", "below its folder"]),
        ("/stimuli/1/video", json!("/etc/x.mp4"), &["`stimuli[1].video`"]),
        ("/stimuli/1/video", json!("C:\\x.mp4"), &["`stimuli[1].video`"]),
        ("/stimuli/1/video", json!("videos/event-0.mp4"), &["twice"]),
        ("/stimuli/0/objects", json!(3), &["`stimuli[0].objects`", "0 to 2"]),
        ("/stimuli/0/relation", json!("angry"), &["`stimuli[0].relation`", "friendly"]),
        ("/stimuli/0/goals", json!(["touch"]), &["`stimuli[0].goals`", "two agents"]),
        ("/stimuli/0/goals", json!(["touch", "fly"]), &["`stimuli[0].goals[1]`", "get away"]),
        ("/stimuli/0/vidoe", json!("x"), &["`stimuli[0].vidoe`", "`video`"]),
        ("/raters_per_video", json!(0), &["`raters_per_video`"]),
        ("/raters_per_video_at_most", json!(1), &["`raters_per_video_at_most`", "3"]),
        ("/videos_per_rater", json!(11), &["`videos_per_rater`", "1 to 10"]),
        ("/between_sources", json!(true), &["`between_sources`", "two sources"]),
        ("/between_sources", json!(1), &["`between_sources`", "true or false"]),
        ("/one_of_each_set", json!(true), &["`one_of_each_set`", "`set`"]),
        ("/answer_before_end", json!("no"), &["`answer_before_end`", "true or false"]),
        ("/stimuli/0/condition", json!("a b"), &["`stimuli[0].condition`"]),
        ("/completion", json!({"url": "http://x.org/"}), &["`completion.url`", "https://"]),
        ("/completion", json!({"url": "https://x.org/\"onload"}), &["`completion.url`"]),
        ("/completion", json!({"url": "https://me@x.org/"}), &["`completion.url`"]),
        ("/completion", json!({"link": "x"}), &["`completion.link`"]),
        ("/parameters", json!(["a b"]), &["`parameters[0]`"]),
        ("/parameters", json!(["a", "a"]), &["`parameters`", "twice"]),
        ("/demographics", json!([{"name": "Age", "text": "?", "kind": "text"}]), &["`demographics[0].name`"]),
        ("/demographics", json!([{"name": "age", "text": "?", "kind": "date"}]), &["`demographics[0].kind`"]),
        (
            "/demographics",
            json!([{"name": "age", "text": "?", "kind": "whole", "from": 9, "to": 3}]),
            &["`demographics[0].to`", "9"],
        ),
        (
            "/catch_trials",
            json!([{"id": "c", "video": "c.mp4", "expected": {"relation": "angry"}}]),
            &["`catch_trials[0].expected.relation`"],
        ),
        (
            "/catch_trials",
            json!([{"id": "c", "video": "c.mp4", "expected": {}}]),
            &["`catch_trials[0].expected`"],
        ),
        ("/catch_failures_allowed", json!(1), &["`catch_failures_allowed`"]),
        ("/rater", json!(1), &["`rater`", "`raters`"]),
        ("/seed", json!(-1), &["`seed`"]),
    ];
    for (pointer, to, expected) in cases {
        let mut wrong = document(Form::Relation, 10, 3, 4);
        let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
        match (wrong.pointer_mut(parent).expect(pointer), key.parse::<usize>()) {
            (Value::Array(items), Ok(k)) => items[k] = to.clone(),
            (Value::Object(members), _) => {
                members.insert(key.into(), to.clone());
            }
            _ => panic!("{pointer}"),
        }
        let error = StudyConfig::read(wrong.to_string().as_bytes(), &forms()).expect_err(pointer).to_string();
        assert!(expected.iter().all(|part| error.contains(part)), "{pointer} {to}: {error}");
        assert_eq!(error.lines().count(), 1);
    }
}

proptest! {
    #[test]
    fn no_bytes_make_it_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = StudyConfig::read(&bytes, &forms());
    }

    #[test]
    fn no_change_of_a_member_makes_it_panic(member in 0_usize..10, to in prop_oneof![
        Just(json!(null)), Just(json!(-1)), Just(json!([])), Just(json!({})), Just(json!("")),
        Just(json!(1e300)), Just(json!([[]])),
    ]) {
        let mut wrong = document(Form::Goals, 3, 2, 2);
        if let Some(value) = wrong.as_object_mut().and_then(|it| it.values_mut().nth(member)) {
            *value = to;
        }
        let _ = StudyConfig::read(wrong.to_string().as_bytes(), &forms());
    }
}
