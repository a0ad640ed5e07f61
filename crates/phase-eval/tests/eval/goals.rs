//! Scores of Task 1, compared with numbers computed by hand.

use phase_eval::{
    GroupScores,
    comparison::GoalDifference,
    goals::{
        Answer, Calibration, ErrorBreakdown, InvalidAnswer, Label, PartialAnswer, RecognisedEvent,
        RecognitionScores, RecognitionSummary, SetScores, canonical,
    },
    predictions,
    trivial::own_goals,
};
use phase_model::{
    AgentId, EventKind, Goal, Judgement, LandmarkId, ObjectId, Relation, RelationProbabilities, Sign,
};
use proptest::prelude::*;
use serde_json::{Value, json};

fn place(agent: u8, landmark: u8, sign: Sign) -> Goal {
    Goal::AgentOnLandmark {
        agent: AgentId::ALL[usize::from(agent)],
        landmark: LandmarkId::ALL[usize::from(landmark)],
        sign,
    }
}

fn touch(agent: u8, other: u8, sign: Sign) -> Goal {
    Goal::Touch { agent: AgentId::ALL[usize::from(agent)], other: AgentId::ALL[usize::from(other)], sign }
}

fn thing(object: u8, landmark: u8) -> Goal {
    Goal::ObjectOnLandmark {
        object: ObjectId::ALL[usize::from(object)],
        landmark: LandmarkId::ALL[usize::from(landmark)],
        sign: Sign::Positive,
    }
}

const PLUS: Sign = Sign::Positive;
const MINUS: Sign = Sign::Negative;

/// An answer that names the goals in this order, less likely from one to the next.
fn answer(goals: [&[Goal]; 2], relation: [f64; 3]) -> Answer {
    let ranked =
        |goals: &[Goal]| goals.iter().zip([0.5, 0.25, 0.125, 0.0625]).map(|(g, p)| (*g, p)).collect();
    let [friendly, adversarial, neutral] = relation;
    let relation = RelationProbabilities { friendly, adversarial, neutral };
    Answer::of(&Judgement { goals: goals.map(ranked), relation, roles: None, reported: None })
        .expect("an answer")
}

#[test]
fn a_goal_is_right_only_if_everything_matches() {
    // What the label says, what was named, and at which place that is right.
    let cases: &[(Goal, &[Goal], Option<usize>)] = &[
        (place(0, 1, PLUS), &[place(0, 1, PLUS)], Some(0)),
        (place(0, 1, PLUS), &[place(0, 1, MINUS)], None),
        (place(0, 1, PLUS), &[place(1, 1, PLUS)], None),
        (place(0, 1, PLUS), &[place(0, 2, PLUS), place(0, 1, PLUS)], Some(1)),
        (place(0, 1, PLUS), &[thing(0, 1)], None),
        (thing(0, 1), &[thing(1, 1), thing(0, 2), thing(0, 1)], Some(2)),
        // A hinderer bears the other's goal negated.
        (place(1, 3, MINUS), &[place(1, 3, MINUS)], Some(0)),
        (place(1, 3, MINUS), &[place(1, 3, PLUS)], None),
        // Whichever agent is named first, they touch each other.
        (touch(1, 0, MINUS), &[touch(0, 1, MINUS)], Some(0)),
        (touch(1, 0, MINUS), &[touch(1, 0, PLUS)], None),
        (touch(0, 1, PLUS), &[], None),
    ];
    for (label, named, expected) in cases {
        let answer = answer([named, &[]], [1.0, 0.0, 0.0]);
        assert_eq!(answer.place(AgentId::ZERO, *label), *expected, "{label:?} among {named:?}");
        assert_eq!(answer.place(AgentId::ONE, *label), None);
    }
}

#[test]
fn mistakes_are_counted_by_what_is_wrong() {
    let kinds = |right: usize, said: usize| {
        let mut kinds = [[0; 3]; 3];
        kinds[right][said] = 1;
        ErrorBreakdown { kinds, ..ErrorBreakdown::default() }
    };
    let cases = [
        (thing(0, 1), Some(thing(0, 1)), ErrorBreakdown { right: 1, ..kinds(1, 1) }),
        (touch(1, 0, MINUS), Some(touch(0, 1, MINUS)), ErrorBreakdown { right: 1, ..kinds(2, 2) }),
        (touch(1, 0, MINUS), Some(touch(1, 0, PLUS)), ErrorBreakdown { sign: 1, ..kinds(2, 2) }),
        (place(1, 3, MINUS), Some(place(1, 3, PLUS)), ErrorBreakdown { sign: 1, ..kinds(0, 0) }),
        (place(1, 3, MINUS), Some(place(1, 2, PLUS)), ErrorBreakdown { landmark: 1, ..kinds(0, 0) }),
        (place(1, 3, MINUS), Some(place(0, 3, PLUS)), ErrorBreakdown { entity: 1, ..kinds(0, 0) }),
        (thing(0, 1), Some(thing(1, 2)), ErrorBreakdown { both: 1, ..kinds(1, 1) }),
        (thing(0, 1), Some(place(0, 1, PLUS)), kinds(1, 0)),
        (place(0, 1, PLUS), Some(touch(0, 1, PLUS)), kinds(0, 2)),
        (place(0, 1, PLUS), None, ErrorBreakdown { nothing: 1, ..ErrorBreakdown::default() }),
    ];
    for (right, said, expected) in cases {
        // The other agent has named nothing.
        let mut event = two_events().swap_remove(0);
        event.label.goals = [right; 2];
        event.answer = answer([&[], said.as_slice()], [1.0, 0.0, 0.0]);
        let expected = ErrorBreakdown { nothing: expected.nothing + 1, ..expected };
        assert_eq!(ErrorBreakdown::of(&[event]), expected, "{said:?} instead of {right:?}");
    }
}

#[test]
fn answers_are_put_in_order_and_the_same_goal_added_up() {
    let goals = vec![(place(0, 0, PLUS), 0.3), (touch(0, 1, PLUS), 0.25), (touch(1, 0, PLUS), 0.25)];
    let judgement = Judgement { goals: [goals, Vec::new()], ..Judgement::default() };
    let answer = Answer::of(&judgement).expect("an answer");
    let found: Vec<(Goal, f64)> = answer.goals[0].iter().map(|share| (share.goal, share.p)).collect();
    assert_eq!(found, [(touch(0, 1, PLUS), 0.5), (place(0, 0, PLUS), 0.3)]);
}

#[test]
fn numbers_that_are_no_probabilities_are_refused() {
    let goals = |p: &[f64]| -> Vec<(Goal, f64)> {
        p.iter().zip(0..).map(|(&p, landmark)| (place(0, landmark, PLUS), p)).collect()
    };
    let third = RelationProbabilities::default();
    let cases = [
        (goals(&[0.5, f64::NAN]), third, InvalidAnswer::Goal { agent: AgentId::ZERO, place: 1 }),
        (goals(&[-0.1]), third, InvalidAnswer::Goal { agent: AgentId::ZERO, place: 0 }),
        (goals(&[f64::INFINITY]), third, InvalidAnswer::Goal { agent: AgentId::ZERO, place: 0 }),
        (goals(&[0.75, 0.5]), third, InvalidAnswer::Goals(AgentId::ZERO)),
        (goals(&[1.0]), RelationProbabilities { neutral: f64::NAN, ..third }, InvalidAnswer::Relation),
        (goals(&[1.0]), RelationProbabilities { neutral: 0.5, ..third }, InvalidAnswer::Relation),
    ];
    for (goals, relation, expected) in cases {
        let judgement = Judgement { goals: [goals, Vec::new()], relation, roles: None, reported: None };
        assert_eq!(Answer::of(&judgement), Err(expected), "{judgement:?}");
    }
}

/// Two events: in the first agent 0 is correct at once and agent 1 at the third goal, in the second neither
/// is.
fn two_events() -> Vec<RecognisedEvent> {
    let a = place(0, 0, PLUS);
    let b = place(0, 1, PLUS);
    let c = place(0, 2, PLUS);
    let label = |kind, relation, relation_human, layout_seen| Label {
        kind,
        goals: [a, b],
        relation,
        relation_human,
        layout_seen,
        role: None,
        ratings: None,
        set: None,
    };
    let event = |id: &str, answer: Answer, label, cpu_seconds| RecognisedEvent {
        id: id.into(),
        watched: vec![PartialAnswer { seconds: 5.0, answer: answer.clone() }],
        answer,
        label,
        cpu_seconds,
        details: Value::Null,
    };
    let helping = EventKind::Helping;
    let chasing = EventKind::Chasing;
    let right = label(helping, Relation::Friendly, Some(Relation::Neutral), Some(true));
    let wrong = label(chasing, Relation::Adversarial, None, Some(false));
    vec![
        event("one", answer([&[a], &[c, a, b]], [0.75, 0.25, 0.0]), right, Some(1.0)),
        event("two", answer([&[c, b], &[c]], [0.0, 0.25, 0.75]), wrong, Some(3.0)),
    ]
}

#[test]
fn two_events_summed_up_by_hand() {
    let summary = RecognitionSummary::of(&two_events(), 1).expect("events");
    let all = &summary.all;
    assert_eq!((all.n, all.top1.value, all.top2.value, all.top3.value), (2, 0.25, 0.25, 0.5));
    assert_eq!(all.relation.value, 0.5);
    // Human judgement exists for the first event only, and differs.
    assert_eq!(all.relation_human.map(|estimate| estimate.value), Some(0.0));
    assert_eq!(summary.confusion, [[1, 0, 0], [0, 0, 1], [0, 0, 0]]);
    assert_eq!(summary.cpu_seconds_per_event, Some(2.0));
    let named = |groups: &[GroupScores<RecognitionScores>]| -> Vec<(String, usize, f64)> {
        groups.iter().map(|it| (it.name.clone(), it.scores.n, it.scores.top1.value)).collect()
    };
    assert_eq!(named(&summary.kinds), [("helping".into(), 1, 0.5), ("chasing".into(), 1, 0.0)]);
    assert_eq!(named(&summary.layouts), [("seen".into(), 1, 0.5), ("unseen".into(), 1, 0.0)]);
    assert_eq!(named(&summary.watched), [("5 s".into(), 2, 0.25)]);
    // Four goals named with 0.5, one right; two relations with 0.75, one right.
    assert!((summary.goal_calibration.error - 0.25).abs() < 1e-12);
    assert!((summary.relation_calibration.error - 0.25).abs() < 1e-12);
    assert_eq!(RecognitionSummary::of(&[], 1), None);
}

#[test]
fn two_methods_compared_by_hand() {
    let one = two_events();
    let same = GoalDifference::of(&one, &one, 1).expect("the same events").expect("events");
    assert_eq!((same.goal.low, same.goal.value, same.goal.high, same.relation.value), (0.0, 0.0, 0.0, 0.0));
    // A method that names no goal, and the other relation, in every event; events in another order.
    let nothing = |event: &RecognisedEvent| {
        let said = event.answer.relation.most_likely();
        let relation = [Relation::Friendly, Relation::Adversarial, Relation::Neutral]
            .map(|relation| f64::from(u8::from(relation != said)) / 2.0);
        RecognisedEvent { answer: answer([&[], &[]], relation), ..event.clone() }
    };
    let other: Vec<_> = one.iter().rev().map(nothing).collect();
    let scores = RecognitionSummary::of(&one, 1).expect("events").all;
    let found = GoalDifference::of(&one, &other, 1).expect("the same events").expect("events");
    assert_eq!(found.goal, scores.top1);
    let back = GoalDifference::of(&other, &one, 1).expect("the same events").expect("events");
    assert_eq!(back.goal.value, -found.goal.value);
    let error = GoalDifference::of(&one, &other[..1], 1).expect_err("one is missing");
    assert_eq!(error.id, one[0].id);
    assert!(GoalDifference::of(&one[..1], &one, 1).is_err());
}

#[test]
fn a_reliability_table_by_hand() {
    // Bin 0.9 to 1: 1.0 right, 0.9 wrong; bin 0.2 to 0.3: 0.2 right.
    let table = Calibration::of(&[(1.0, true), (0.9, false), (0.2, true)]);
    let filled: Vec<(usize, usize)> =
        table.bins.iter().enumerate().filter(|(_, bin)| bin.n > 0).map(|(k, bin)| (k, bin.n)).collect();
    assert_eq!(filled, [(2, 1), (9, 2)]);
    assert!((table.bins[9].confidence - 0.95).abs() < 1e-12 && table.bins[9].accuracy == 0.5);
    // (2 · |0.95 − 0.5| + 1 · |0.2 − 1|) / 3
    assert!((table.error - (0.9 + 0.8) / 3.0).abs() < 1e-12, "{}", table.error);
    assert_eq!(Calibration::of(&[]).error, 0.0);
}

#[test]
fn an_agents_own_goals_are_all_different() {
    for (objects, count) in [(0, 6), (1, 10), (2, 14)] {
        for agent in AgentId::ALL {
            let mut goals: Vec<Goal> = own_goals(agent, objects).into_iter().map(canonical).collect();
            goals.sort();
            goals.dedup();
            assert_eq!(goals.len(), count, "{objects} objects");
        }
    }
    // As in labels of a chase: the agent that approaches is named first.
    assert!(
        own_goals(AgentId::ZERO, 0).contains(&touch(1, 0, MINUS))
            && own_goals(AgentId::ONE, 0).contains(&touch(1, 0, PLUS))
    );
}

#[test]
fn kept_events_and_predictions_read_back_as_they_were() {
    let events = two_events();
    let text = serde_json::to_string(&events).expect("JSON");
    assert_eq!(serde_json::from_str::<Vec<RecognisedEvent>>(&text).expect("events"), events);
    let read = predictions::goals(&json!({ "events": events })).expect("predictions");
    assert_eq!(read.len(), 2);
    assert_eq!(read["one"], events[0].answer);
}

#[test]
fn predictions_that_will_not_do() {
    let good = json!({ "events": [{
        "id": "a", "goals": [[{ "goal": place(0, 0, PLUS), "p": 0.5 }], []],
        "relation": { "friendly": 1.0, "adversarial": 0.0, "neutral": 0.0 },
    }] });
    assert!(predictions::goals(&good).is_ok());
    let cases = [
        ("/events", json!([]), "at least one event"),
        ("/events", json!(3), "`events` must be an array"),
        ("/events/0/id", json!(3), "`id` must be a text"),
        ("/events/0/goals", json!([[]]), "event a: field `goals` must hold 2 lists"),
        ("/events/0/goals/0/0/goal", json!({ "kind": "dance" }), "`goals[0][0].goal` is no goal"),
        ("/events/0/goals/0/0/p", json!(1.5), "`goals[0][0].p` must be a number from 0 to 1"),
        ("/events/0/goals/0/0/p", json!(null), "`goals[0][0].p` must be a number"),
        ("/events/0/relation/neutral", json!(1.0), "event a: field `relation` must have three numbers"),
        ("/events/0/relation", json!({}), "`relation.friendly` is missing"),
    ];
    for (pointer, to, part) in cases {
        let mut bad = good.clone();
        *bad.pointer_mut(pointer).expect(pointer) = to;
        let problem = predictions::goals(&bad).expect_err(pointer).to_string();
        assert!(problem.contains(part), "{pointer}: {problem}");
    }
    let twice = json!({ "events": [good["events"][0], good["events"][0]] });
    assert!(predictions::goals(&twice).expect_err("twice").to_string().contains("must differ"));
}

/// Three events: two of one set, of which one relation is wrong, and one of another, all right.
#[test]
fn a_set_is_right_if_all_of_its_events_are() {
    let two = two_events();
    let of_set = |event: &RecognisedEvent, id: &str, set: &str, relation| {
        let mut event = event.clone();
        (event.id, event.label.set, event.label.relation) = (id.into(), Some(set.into()), relation);
        event
    };
    let friendly = |id, set| of_set(&two[0], id, set, Relation::Friendly);
    let mistaken = of_set(&two[0], "c", "first", Relation::Neutral);
    let scores =
        SetScores::of(&[friendly("a", "first"), mistaken, friendly("b", "second")], 1).expect("sets");
    assert_eq!((scores.n, scores.relation.value), (2, 0.5));
    // Agent 1's goal is the second one named.
    assert_eq!((scores.goals.value, scores.all.value), (0.0, 0.0));
    assert_eq!(SetScores::of(&two, 1), None);
}

proptest! {
    /// Further goals never reduce a score, no share leaves 0 to 1, and the mean lies in its interval.
    #[test]
    fn scores_are_ordered(orders in prop::collection::vec((0..14_usize, 0..14_usize, 0..3_usize), 1..12)) {
        let goals = own_goals(AgentId::ZERO, 2);
        let event = |&(first, right, relation): &(usize, usize, usize)| {
            let named: Vec<Goal> = (0..4).map(|k| goals[(first + k) % goals.len()]).collect();
            let mut sure = [0.0; 3];
            sure[relation] = 1.0;
            RecognisedEvent {
                id: "x".into(),
                answer: answer([&named, &named], sure),
                label: Label {
                    kind: EventKind::Independent,
                    goals: [goals[right]; 2],
                    relation: Relation::Neutral,
                    relation_human: None,
                    layout_seen: None,
                    role: None,
                    ratings: None,
                    set: None,
                },
                watched: Vec::new(),
                cpu_seconds: None,
                details: Value::Null,
            }
        };
        let events: Vec<RecognisedEvent> = orders.iter().map(event).collect();
        let all = RecognitionSummary::of(&events, 7).expect("events").all;
        prop_assert!(all.top1.value <= all.top2.value && all.top2.value <= all.top3.value);
        for estimate in [all.top1, all.top2, all.top3, all.relation] {
            prop_assert!(0.0 <= estimate.low && estimate.low <= estimate.value + 1e-12);
            prop_assert!(estimate.value <= estimate.high + 1e-12 && estimate.high <= 1.0);
        }
    }
}
