//! Roles, and agreement with people who rated events.

use phase_eval::{
    goals::{
        Agreement, Answer, Label, Protocol, ProtocolError, REPORT_TRAINING_FORMAT, RecognisedEvent,
        RecognitionSummary, ReportTraining, RoleScores, SocialRole, UNIFORM_SHARE,
    },
    ratings::{RatingCounts, ratings},
};
use phase_model::{
    AgentId, Attitude, EventKind, Goal, LandmarkId, Relation, RelationProbabilities, RoleProbabilities, Sign,
};
use proptest::prelude::*;
use serde_json::{Value, json};

fn event(
    said: [f64; 3],
    rated: Option<[usize; 3]>,
    role: Option<SocialRole>,
    roles: Option<RoleProbabilities>,
) -> RecognisedEvent {
    let goal = |agent| Goal::AgentOnLandmark { agent, landmark: LandmarkId::TOP_LEFT, sign: Sign::Positive };
    let [friendly, adversarial, neutral] = said;
    let answer = Answer {
        goals: Default::default(),
        relation: RelationProbabilities { friendly, adversarial, neutral },
        roles,
        reported: None,
    };
    let ratings =
        rated.map(|[friendly, adversarial, neutral]| RatingCounts { friendly, adversarial, neutral });
    let label = Label {
        kind: EventKind::Helping,
        goals: AgentId::ALL.map(goal),
        relation: Relation::Friendly,
        relation_human: None,
        layout_seen: None,
        role,
        ratings,
        set: None,
    };
    RecognisedEvent {
        id: "e".into(),
        answer,
        label,
        watched: Vec::new(),
        cpu_seconds: None,
        details: Value::Null,
    }
}

fn rated(said: [f64; 3], rated: [usize; 3]) -> RecognisedEvent {
    event(said, Some(rated), None, None)
}

#[test]
fn whoever_says_what_people_say_agrees_with_them() {
    let events = [
        rated([0.9, 0.1, 0.0], [9, 1, 0]),
        rated([0.0, 1.0, 0.0], [0, 12, 0]),
        rated([0.25, 0.25, 0.5], [5, 5, 10]),
        event([1.0, 0.0, 0.0], None, None, None),
    ];
    let agreement = Agreement::of(&events, 1).expect("rated events");
    assert_eq!((agreement.n, agreement.ratings), (3, 42));
    assert!((agreement.correlation.expect("varied").value - 1.0).abs() < 1e-12);
    assert!((agreement.similarity.expect("varied").value - 1.0).abs() < 1e-12);
    assert_eq!(agreement.mode.value, 1.0);
    // By hand: entropies of (.9, .1), (1), (.25, .25, .5), each with 1 % uniform in the logarithm.
    let log = |p: f64| ((1.0 - UNIFORM_SHARE) * p + UNIFORM_SHARE / 3.0).ln();
    let by_hand = -(0.9 * log(0.9) + 0.1 * log(0.1) + log(1.0) + 0.5 * log(0.25) + 0.5 * log(0.5)) / 3.0;
    assert!((agreement.cross_entropy.value - by_hand).abs() < 1e-12);
    let ceiling = agreement.ceiling.expect("several raters");
    let entropy = (0.9 * 0.9_f64.ln() + 0.1 * 0.1_f64.ln() + 0.5 * 0.25_f64.ln() + 0.5 * 0.5_f64.ln()) / -3.0;
    assert!((ceiling.entropy - entropy).abs() < 1e-12);
    assert!(ceiling.correlation.expect("varied") > 0.9 && ceiling.mode > 0.6, "{ceiling:?}");
}

#[test]
fn a_constant_answer_has_no_correlation() {
    let events = [rated([1.0 / 3.0; 3], [9, 1, 0]), rated([1.0 / 3.0; 3], [0, 3, 0])];
    let agreement = Agreement::of(&events, 1).expect("rated events");
    assert_eq!((agreement.correlation, agreement.similarity), (None, None));
    assert!((agreement.cross_entropy.value - 3.0_f64.ln()).abs() < 1e-12);
    // Of equal probabilities the first counts: friendly.
    assert_eq!(agreement.mode.value, 0.5);
    assert_eq!(Agreement::of(&[event([1.0, 0.0, 0.0], None, None, None)], 1), None);
    assert_eq!(Agreement::of(&[rated([1.0, 0.0, 0.0], [1, 0, 0])], 1).expect("rated").ceiling, None);
}

proptest! {
    /// No probabilities have a lower cross-entropy than the raters' own shares, apart from the uniform share.
    #[test]
    fn the_entropy_of_people_is_the_least_cross_entropy(
        counts in prop::array::uniform3(0_usize..12), weights in prop::array::uniform3(0.01_f64..1.0),
    ) {
        prop_assume!(counts.iter().sum::<usize>() > 1);
        let sum: f64 = weights.iter().sum();
        let agreement = Agreement::of(&[rated(weights.map(|it| it / sum), counts)], 1).expect("rated");
        let entropy = agreement.ceiling.expect("several raters").entropy;
        prop_assert!(agreement.cross_entropy.value >= entropy - 1e-9);
    }
}

#[test]
fn the_likelier_of_two_helpers_is_the_one_named() {
    let help = |agent| Some(SocialRole { agent, attitude: Attitude::Help });
    let said = |helps| Some(RoleProbabilities { helps, hinders: [0.0, 0.1] });
    let friendly = [1.0, 0.0, 0.0];
    let events = [
        event(friendly, None, help(AgentId::ZERO), said([0.3, 0.1])),
        event(friendly, None, help(AgentId::ONE), said([0.4, 0.4])),
        event(friendly, None, help(AgentId::ONE), said([0.0, 0.0])),
        event(friendly, None, help(AgentId::ZERO), said([0.2, 0.6])),
        event(friendly, None, None, said([0.9, 0.0])),
    ];
    let scores = RoleScores::of(&events, 1).expect("social events");
    assert_eq!(scores.n, 4);
    assert!((scores.named.value - 0.25).abs() < 1e-12);
    // Shares 3/4, 1/2, 1/2 and 1/4.
    let brier = (1.0 / 16.0 + 0.25 + 0.25 + 9.0 / 16.0) / 4.0;
    assert!((scores.brier.value - brier).abs() < 1e-12);
    let silent = event(friendly, None, help(AgentId::ZERO), None);
    assert_eq!(RoleScores::of([&events[0], &silent], 1), None, "a method that does not say has no score");
    assert_eq!(RoleScores::of(&events[4..], 1), None);
}

#[test]
fn files_of_ratings() {
    let file = json!({
        "format": "phase-ratings/1",
        "ratings": {
            "a": {"friendly": 3, "neutral": 0, "adversarial": 1},
            "b": {"friendly": 0, "neutral": 1, "adversarial": 0}
        },
    });
    let read = ratings(&file).expect("ratings");
    assert_eq!(read["a"].counts(), [3, 1, 0]);
    assert_eq!(read["b"].raters(), 1);
    let cases: [(&str, Value, &str); 7] = [
        ("/format", json!("phase-ratings/2"), "phase-ratings/2"),
        ("/ratings", json!([]), "`ratings` must be an object"),
        ("/ratings", json!({}), "`ratings` must hold at least one event"),
        ("/ratings/a/friendly", json!(-1), "event a: field `friendly`"),
        ("/ratings/a/friendly", json!(1.5), "event a: field `friendly`"),
        ("/ratings/b/neutral", json!(0), "at least one rater"),
        ("/ratings/b", json!({"friendly": 1, "neutral": 0, "adversarial": 0, "odd": 0}), "odd"),
    ];
    for (place, value, part) in cases {
        let mut wrong = file.clone();
        *wrong.pointer_mut(place).expect("a member") = value;
        let sentence = ratings(&wrong).expect_err(part).to_string();
        assert!(sentence.contains(part), "{sentence}");
    }
}

/// An evaluation of the events that a model of reports was fitted to is labelled, and shows the figures held
/// out; others stay.
#[test]
fn agreement_with_known_ratings_is_labelled_in_sample() {
    let reported = |said: [f64; 3], predicted: [f64; 3], counts| {
        let mut event = event(said, Some(counts), None, None);
        let [friendly, adversarial, neutral] = predicted;
        event.answer.reported = Some(RelationProbabilities { friendly, adversarial, neutral });
        event
    };
    let events = [
        reported([0.6, 0.2, 0.2], [0.8, 0.1, 0.1], [8, 1, 1]),
        reported([0.2, 0.6, 0.2], [0.1, 0.8, 0.1], [1, 8, 1]),
    ];
    let summary = RecognitionSummary::of(&events, 1).expect("events");
    let in_sample = summary.agreement.clone().expect("ratings");
    let other = summary.relation_agreement.clone().expect("reports");
    let record = ReportTraining {
        format: REPORT_TRAINING_FORMAT.into(),
        events_sha256: "ab".into(),
        seed: 1,
        in_sample: Agreement { protocol: Protocol::InSample, ..in_sample },
        held_out: Agreement { protocol: Protocol::HeldOut { folds: 2 }, ..other },
    };
    assert_eq!(record.check(&summary), Err(ProtocolError::InSample), "not labelled yet");
    let mut labelled = summary.clone();
    record.label(&mut labelled, "ab");
    assert_eq!(labelled.agreement.as_ref(), Some(&record.in_sample));
    assert_eq!(labelled.held_out_agreement.as_ref(), Some(&record.held_out));
    assert_eq!(record.check(&labelled), Ok(()));
    let mut elsewhere = summary.clone();
    record.label(&mut elsewhere, "cd");
    assert_eq!(elsewhere, summary, "other events");
    // Of a part of the events there are no figures held out.
    let mut part = RecognitionSummary::of(&events[..1], 1).expect("an event");
    record.label(&mut part, "ab");
    assert_eq!(part.agreement.map(|it| it.protocol), Some(Protocol::InSample));
    assert_eq!(part.held_out_agreement, None);
}
